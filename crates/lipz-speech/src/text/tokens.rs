//! The words of a text, in order, with the breaks between its segments.

use super::apostrophe::extended;
use super::display::Display;
use super::runs::{Writing, writing};
use super::say::{self, Say};
use crate::ProblemKind;
use lipz_file::text::segments;
use std::collections::{HashMap, HashSet};
use std::ops::Range;
use unicode_segmentation::UnicodeSegmentation;

/// What a text is divided into.
#[derive(Debug)]
pub(crate) enum Item {
    /// A `|`.
    Break,
    Token(Token),
}

/// Something that is said.
#[derive(Clone, Debug)]
pub(crate) struct Token {
    /// As it is displayed.
    pub(crate) text: String,
    /// Where it is in the text.
    pub(crate) range: Range<usize>,
    pub(crate) kind: Kind,
}

#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) enum Kind {
    /// A word that is read.
    Word,
    /// A number or a sign, with all ways to write it in words.
    Spelled(Vec<String>),
    /// What somebody wrote how to say.
    Say(Say),
}

/// What a word has to be known for: its language, and its dictionaries.
pub(crate) struct Context<'c> {
    pub(crate) japanese: bool,
    /// How many words the longest entry of the lexicon has.
    pub(crate) longest_entry: usize,
    /// Whether the lexicon has several words as one.
    pub(crate) entry: &'c dyn Fn(&str) -> bool,
    /// Whether a dictionary has the word.
    pub(crate) known: &'c dyn Fn(&str) -> bool,
    /// The number or sign that begins at a place of a text.
    pub(crate) spelled: &'c dyn Fn(&str, usize) -> Option<Spelling>,
}

/// A number or a sign in words.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Spelling {
    /// How many bytes of the text it is.
    pub(crate) length: usize,
    /// All ways to write it in words, the most likely first.
    pub(crate) readings: Vec<String>,
}

/// The longest name in `{say name: …}`, in words.
const LONGEST_NAME: usize = 16;

/// Divides a text. What is odd about its `{say …}` goes to `problems`.
pub(crate) fn items(text: &str, context: &Context<'_>, problems: &mut Vec<(ProblemKind, Range<usize>)>) -> Vec<Item> {
    let displays: Vec<Display> = segments(text).map(|segment| Display::new(text, segment)).collect();
    let mut names = Names::new(text, &displays, context, problems);
    let mut items = Vec::new();
    for (index, display) in displays.iter().enumerate() {
        if index > 0 {
            items.push(Item::Break);
        }
        let words = names.apply(display, words(&display.text, context));
        let words = joined(entries(&display.text, words, context), context);
        items.extend(with_says(text, display, words).into_iter().map(Item::Token));
    }
    problems.extend(names.unused().map(|range| (ProblemKind::NameNotInText, range)));
    problems.sort_by_key(|(_, range)| range.start);
    items
}

/// The words of a displayed text, as Unicode divides them, with numbers and signs; ranges are those of that text.
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
            words.push(token(start..end, Kind::Spelled(readings)));
        } else if piece.contains(char::is_alphanumeric) {
            let mut range = extended(text, start..start + piece.len(), context.known);
            range.start = range.start.max(end);
            end = range.end;
            words.push(token(range, Kind::Word));
        }
    }
    words
}

/// Makes one word of words that the lexicon has as one: `New York`, `Jean-Luc`.
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
            let plain = run.iter().all(|word| !matches!(word.kind, Kind::Say(_)));
            let entry = text.get(range.clone()).filter(|entry| plain && (context.entry)(entry))?;
            Some((count, Token { text: entry.to_owned(), range, kind: Kind::Word }))
        });
        let (count, token) = found.unwrap_or_else(|| (1, first.clone()));
        out.push(token);
        at += count;
    }
    out
}

/// Joins what is one word in scripts without spaces.
fn joined(words: Vec<Token>, context: &Context<'_>) -> Vec<Token> {
    let class = |token: &Token| match token.kind {
        Kind::Word => token.text.chars().map(writing).find(|writing| *writing != Writing::None),
        _ => None,
    };
    let mut joined: Vec<(Token, Option<Writing>)> = Vec::new();
    for token in words {
        let writing = class(&token);
        if let Some((last, class)) = joined.last_mut() {
            let long_vowel = token.text.starts_with('ー') && *class == Some(Writing::Hiragana);
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

/// Gives each `{say: …}` to the word before it. Ranges become those of the whole text.
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
                // `“Xylara” {say: …}` is about Xylara, but not `Well, {say: um}` about well.
                let closes =
                    |c: char| c.is_whitespace() || matches!(c, ')' | ']' | '"' | '\'' | '”' | '’' | '»' | '」' | '』');
                let between =
                    |end: &usize| *end >= *at || display.text.get(*end..*at).is_some_and(|gap| gap.chars().all(closes));
                // A word that has one already is followed by something that is said in addition.
                let last = out
                    .last_mut()
                    .filter(|last| ends.last().is_some_and(between) && !matches!(last.kind, Kind::Say(_)));
                match last {
                    Some(last) => {
                        last.kind = Kind::Say(say.clone());
                        join_stem(&mut out);
                        ends.truncate(out.len());
                    }
                    None => {
                        out.push(Token {
                            text: say.how.clone(),
                            range: say.range.clone(),
                            kind: Kind::Say(say.clone()),
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

/// `食べる{say: たべる}`: what is said ends with the kana before it, so it says the characters before these, too.
fn join_stem(tokens: &mut Vec<Token>) {
    let [.., stem, kana] = tokens.as_slice() else { return };
    let Kind::Say(say) = &kana.kind else { return };
    let is = |token: &Token, class| token.text.chars().all(|c| writing(c) == class || c == 'ー');
    let longer = say.how.len() > kana.text.len() && say.how.ends_with(&kana.text);
    if longer
        && stem.kind == Kind::Word
        && stem.range.end == kana.range.start
        && is(stem, Writing::Han)
        && is(kana, Writing::Hiragana)
    {
        let Some(kana) = tokens.pop() else { return };
        let Some(stem) = tokens.last_mut() else { return };
        stem.text.push_str(&kana.text);
        stem.range.end = kana.range.end;
        stem.kind = kana.kind;
    }
}

/// `{say name: …}` of a text: they are about the name wherever it stands.
struct Names {
    says: HashMap<Vec<String>, (Say, Range<usize>)>,
    used: HashSet<Vec<String>>,
    longest: usize,
}

impl Names {
    fn new(
        text: &str,
        displays: &[Display],
        context: &Context<'_>,
        problems: &mut Vec<(ProblemKind, Range<usize>)>,
    ) -> Names {
        let mut names = Names { says: HashMap::new(), used: HashSet::new(), longest: 0 };
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

    /// Makes one token of the words of each name.
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
            out.push(Token { text, range, kind: Kind::Say(say) });
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
