//! The words of a text in order, with the breaks between its segments.

use super::apostrophe::extended;
use super::display::Display;
use super::runs::{WritingSystem, writing};
use super::say::{self, Say};
use super::stutter;
use crate::ProblemKind;
use lipz_file::text::segments;
use std::collections::{HashMap, HashSet};
use std::ops::Range;
use unicode_segmentation::UnicodeSegmentation;

/// The parts of a text.
#[derive(Debug)]
pub(crate) enum Item {
    /// A `|`.
    Break,
    Token(Token),
}

/// A spoken part of a text.
#[derive(Clone, Debug)]
pub(crate) struct Token {
    /// The text as displayed.
    pub(crate) text: String,
    /// Its range in the text.
    pub(crate) range: Range<usize>,
    pub(crate) kind: TokenKind,
}

#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) enum TokenKind {
    /// A word.
    Word,
    /// A number or a sign, with all its readings in words.
    Spelled(Vec<String>),
    /// The start of a word that is said again: `W-` in `W-wait`. The value is the whole word.
    Stutter(String),
    /// A word with an explicit pronunciation.
    Say(Say),
}

/// The language and dictionaries with which a text is divided.
pub(crate) struct Context<'c> {
    pub(crate) japanese: bool,
    /// The number of words in the longest entry of the lexicon.
    pub(crate) longest_entry: usize,
    /// Whether the lexicon has an entry for several words.
    pub(crate) entry: &'c dyn Fn(&str) -> bool,
    /// Whether a dictionary contains the word.
    pub(crate) known: &'c dyn Fn(&str) -> bool,
    /// Returns the number or sign that begins at an offset of a text.
    pub(crate) spelled: &'c dyn Fn(&str, usize) -> Option<Spelling>,
}

/// A number or a sign in words.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Spelling {
    /// The length in bytes.
    pub(crate) length: usize,
    /// All its readings in words, the most likely first.
    pub(crate) readings: Vec<String>,
}

/// The most words in the name of a `{say name: …}`.
const LONGEST_NAME: usize = 16;

/// Divides a text. Problems of its `{say …}` are added to `problems`.
pub(crate) fn items(text: &str, context: &Context<'_>, problems: &mut Vec<(ProblemKind, Range<usize>)>) -> Vec<Item> {
    let displays: Vec<Display> = segments(text).map(|segment| Display::new(text, segment)).collect();
    let mut names = NameSays::new(text, &displays, context, problems);
    let mut items = Vec::new();
    for (index, display) in displays.iter().enumerate() {
        if index > 0 {
            items.push(Item::Break);
        }
        let words = names.apply(display, words(&display.text, context));
        let mut words = joined(entries(&display.text, words, context), context);
        stutter::mark(&display.text, &mut words, context.known);
        items.extend(with_says(text, display, words).into_iter().map(Item::Token));
    }
    problems.extend(names.unused().map(|range| (ProblemKind::NameNotInText, range)));
    problems.sort_by_key(|(_, range)| range.start);
    items
}

/// Returns the words of a displayed text by Unicode rules, with numbers and signs. Ranges refer to that text.
fn words(text: &str, context: &Context<'_>) -> Vec<Token> {
    let mut words: Vec<Token> = Vec::new();
    let mut end = 0;
    for (start, piece) in text.split_word_bound_indices() {
        if start < end {
            continue; // part of a number
        }
        let token = |range: Range<usize>, kind| Token {
            text: text.get(range.clone()).unwrap_or_default().to_owned(),
            range,
            kind,
        };
        if let Some(Spelling { length, readings }) = (context.spelled)(text, start) {
            end = start + length.max(1);
            words.push(token(start..end, TokenKind::Spelled(readings)));
        } else if piece.contains(char::is_alphanumeric) {
            let mut range = extended(text, start..start + piece.len(), context.known);
            range.start = range.start.max(end);
            end = range.end;
            words.push(token(range, TokenKind::Word));
        }
    }
    words
}

/// Joins words that are one entry of the lexicon: `New York`, `Jean-Luc`.
fn entries(text: &str, words: Vec<Token>, context: &Context<'_>) -> Vec<Token> {
    if context.longest_entry < 2 {
        return words;
    }
    let mut out = Vec::with_capacity(words.len());
    let mut at = 0;
    while let Some(first) = words.get(at) {
        let longest = context.longest_entry.min(words.len() - at);
        let found = (2..=longest).rev().find_map(|count| {
            let run = words.get(at..at + count)?;
            let range = first.range.start..run.last()?.range.end;
            let plain = run.iter().all(|word| !matches!(word.kind, TokenKind::Say(_)));
            let entry = text.get(range.clone()).filter(|entry| plain && (context.entry)(entry))?;
            Some((count, Token { text: entry.to_owned(), range, kind: TokenKind::Word }))
        });
        let (count, token) = found.unwrap_or_else(|| (1, first.clone()));
        out.push(token);
        at += count;
    }
    out
}

/// Joins the parts of words in scripts without spaces.
fn joined(words: Vec<Token>, context: &Context<'_>) -> Vec<Token> {
    let class = |token: &Token| match token.kind {
        TokenKind::Word => token.text.chars().map(writing).find(|writing| *writing != WritingSystem::None),
        _ => None,
    };
    let mut joined: Vec<(Token, Option<WritingSystem>)> = Vec::new();
    for token in words {
        let writing = class(&token);
        if let Some((last, class)) = joined.last_mut() {
            let long_vowel = token.text.starts_with('ー') && *class == Some(WritingSystem::Hiragana);
            let same = *class == writing && writing.is_some_and(|writing| writing.joins(context.japanese));
            if last.range.end == token.range.start && (same || long_vowel) {
                last.range.end = token.range.end;
                last.text.push_str(&token.text);
                continue;
            }
        }
        joined.push((token, writing));
    }
    joined.into_iter().map(|(token, _)| token).collect()
}

/// Assigns each `{say: …}` to the word before it. Ranges become those of the whole text.
fn with_says(text: &str, display: &Display, words: Vec<Token>) -> Vec<Token> {
    let mut says = display.metas.iter().filter_map(|(at, range)| match say::parse(text, range.clone())? {
        (None, say) => Some((*at, say)),
        _ => None,
    });
    let mut next = says.next();
    let mut out: Vec<Token> = Vec::with_capacity(words.len());
    let mut words = words.into_iter().peekable();
    let mut ends: Vec<usize> = Vec::new();
    loop {
        let word_start = words.peek().map(|word| word.range.start);
        match &next {
            Some((at, say)) if word_start.is_none_or(|start| *at <= start) => {
                // `“Xylara” {say: …}` applies to Xylara, but in `Well, {say: um}` it does not apply to *well*.
                let closes =
                    |c: char| c.is_whitespace() || matches!(c, ')' | ']' | '"' | '\'' | '”' | '’' | '»' | '」' | '』');
                let between =
                    |end: &usize| *end >= *at || display.text.get(*end..*at).is_some_and(|gap| gap.chars().all(closes));
                // After a word that already has one, it is an additional spoken word.
                let last = out
                    .last_mut()
                    .filter(|last| ends.last().is_some_and(between) && !matches!(last.kind, TokenKind::Say(_)));
                match last {
                    Some(last) => {
                        last.kind = TokenKind::Say(say.clone());
                        join_stem(&mut out);
                        ends.truncate(out.len());
                    }
                    None => {
                        out.push(Token {
                            text: say.how.clone(),
                            range: say.range.clone(),
                            kind: TokenKind::Say(say.clone()),
                        });
                        ends.push(*at);
                    }
                }
                next = says.next();
            }
            _ => {
                let Some(mut word) = words.next() else { break };
                ends.push(word.range.end);
                word.range = display.range(&word.range);
                out.push(word);
            }
        }
    }
    out
}

/// In `食べる{say: たべる}`, the reading ends with the kana before it, so it also applies to the characters before these.
fn join_stem(tokens: &mut Vec<Token>) {
    let [.., stem, kana] = tokens.as_slice() else { return };
    let TokenKind::Say(say) = &kana.kind else { return };
    let is = |token: &Token, class| token.text.chars().all(|c| writing(c) == class || c == 'ー');
    let longer = say.how.len() > kana.text.len() && say.how.ends_with(&kana.text);
    if longer
        && stem.kind == TokenKind::Word
        && stem.range.end == kana.range.start
        && is(stem, WritingSystem::Han)
        && is(kana, WritingSystem::Hiragana)
    {
        let Some(kana) = tokens.pop() else { return };
        let Some(stem) = tokens.last_mut() else { return };
        stem.text.push_str(&kana.text);
        stem.range.end = kana.range.end;
        stem.kind = kana.kind;
    }
}

/// The `{say name: …}` of a text. They apply to every occurrence of the name.
struct NameSays {
    says: HashMap<Vec<String>, (Say, Range<usize>)>,
    used: HashSet<Vec<String>>,
    longest: usize,
}

impl NameSays {
    fn new(
        text: &str,
        displays: &[Display],
        context: &Context<'_>,
        problems: &mut Vec<(ProblemKind, Range<usize>)>,
    ) -> NameSays {
        let mut names = NameSays { says: HashMap::new(), used: HashSet::new(), longest: 0 };
        for (_, meta) in displays.iter().flat_map(|display| &display.metas) {
            let Some((Some(name), say)) = say::parse(text, meta.clone()) else { continue };
            let key: Vec<String> =
                words(text.get(name.clone()).unwrap_or_default(), context).iter().map(folded).collect();
            if key.is_empty() || key.len() > LONGEST_NAME {
                problems.push((ProblemKind::NameNotInText, name));
                continue;
            }
            names.longest = names.longest.max(key.len());
            names.says.insert(key, (say, name));
        }
        names
    }

    /// Joins the words of each name into one token.
    fn apply(&mut self, display: &Display, words: Vec<Token>) -> Vec<Token> {
        if self.says.is_empty() {
            return words;
        }
        let folded: Vec<String> = words.iter().map(folded).collect();
        let mut out = Vec::with_capacity(words.len());
        let mut at = 0;
        while at < words.len() {
            let longest = self.longest.min(words.len() - at);
            let found = (1..=longest).rev().find_map(|count| {
                let key = folded.get(at..at + count)?;
                self.says.get_key_value(key).map(|(key, (say, _))| (count, key.clone(), say.clone()))
            });
            let (Some(first), Some((count, key, say))) = (words.get(at), found) else {
                out.extend(words.get(at).cloned());
                at += 1;
                continue;
            };
            let range = first.range.start..words.get(at + count - 1).map_or(first.range.end, |last| last.range.end);
            let text = display.text.get(range.clone()).unwrap_or_default().to_owned();
            out.push(Token { text, range, kind: TokenKind::Say(say) });
            self.used.insert(key);
            at += count;
        }
        out
    }

    fn unused(&self) -> impl Iterator<Item = Range<usize>> + '_ {
        let unused = self.says.iter().filter(|(key, _)| !self.used.contains(*key));
        unused.map(|(_, (_, name))| name.clone())
    }
}

fn folded(token: &Token) -> String {
    token.text.to_lowercase().replace('’', "'")
}
