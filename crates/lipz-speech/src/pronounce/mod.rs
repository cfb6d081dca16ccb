//! Conversion of a text to words with all their pronunciations.

mod english;
mod hangul;
mod ipa;
mod kana;
mod latin;
mod lexicon;
mod link;
mod mandarin;
mod readings;
mod rules;
mod said;
mod stutter;
mod variants;
mod word;

pub(crate) use ipa::phones as ipa_phones;
pub use lexicon::Lexicon;

use crate::text::{Context, Item, Spelling, Token, TokenKind, items, numbers};
use crate::{Language, Origin, Problem, ProblemKind, Pronunciation, Script, Word};
use std::collections::HashMap;

/// Finds the pronunciations of the words of a text. The first of these that contains a word is used: the project's
/// lexicon, the dictionary of the language, its letter-to-sound rules, or the names of the letters.
///
/// ```
/// use lipz_speech::{Language, Lexicon, Pronouncer};
/// let lexicon = Lexicon::parse("WESNOTH  W EH S N AO TH\n");
/// let pronouncer = Pronouncer::new(Language::ENGLISH).with_lexicon(lexicon);
/// let script = pronouncer.script("To Wesnoth, {sighs}Li'sar{say: lee-sar}!| At last!");
/// let words: Vec<String> = script.words.iter().map(ToString::to_string).collect();
/// assert_eq!(words, ["To  T UW", "Wesnoth  W EH S N AO TH", "Li'sar  L IY S AA R", "At  AE T", "last  L AE S T"]);
/// assert_eq!(script.breaks, [3]);
/// ```
///
/// # Annotations in texts
///
/// A meta `{say: …}` sets the pronunciation of the word before it, in this position. `{say name: …}` applies to all
/// occurrences of a name in the text, which may be several words. The part after the colon is one of these:
///
/// * a plain respelling, read as words of the language: `Li'sar{say: lee-sar}`, `東京{say: とうきょう}`; a hyphen joins
///   syllables;
/// * phones of ARPAbet in capitals: `Li'sar{say: L IY S AA R}`;
/// * IPA between slashes or brackets: `Li'sar{say: /liːˈsɑːr/}`;
/// * nothing, if the word is displayed but not spoken: `(door){say:}`.
///
/// If there is no word before it (at the start of a segment, or after a comma), it is spoken in addition, but not
/// displayed: `Well, {say: um} I think so.`
#[derive(Clone, Debug)]
pub struct Pronouncer {
    language: Language,
    lexicon: Lexicon,
}

/// The result of reading a text.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
#[non_exhaustive]
pub struct Reading {
    /// The words of the text.
    pub script: Script,
    /// The problems of the text, in order. Ranges are bytes of the text.
    pub problems: Vec<Problem>,
}

impl Pronouncer {
    /// Returns a pronouncer for texts in a language, without a lexicon.
    pub fn new(language: Language) -> Pronouncer {
        Pronouncer { language, lexicon: Lexicon::default() }
    }

    /// Adds a project's own pronunciations. They override all other sources.
    #[must_use]
    pub fn with_lexicon(mut self, lexicon: Lexicon) -> Pronouncer {
        self.lexicon.extend(lexicon);
        self
    }

    /// Returns the language of the texts.
    pub fn language(&self) -> Language {
        self.language
    }

    /// Returns the words of a text with their pronunciations. The text is the value of `text_ll-cc`, with `|` and
    /// `{meta}`. Ranges are bytes of `text`.
    pub fn script(&self, text: &str) -> Script {
        self.read(text).script
    }

    /// Returns the words of a text with their pronunciations, and the problems of the text.
    pub fn read(&self, text: &str) -> Reading {
        let mut problems = Vec::new();
        let context = self.context();
        let items = items(text, &context.borrow(), &mut problems);
        let mut reading = Reading::default();
        reading.problems.extend(problems.into_iter().map(|(kind, range)| Problem { kind, range }));
        // A cache, because texts repeat words.
        let mut seen: HashMap<String, Vec<Pronunciation>> = HashMap::new();
        // The end of a word in a script other than kana.
        let mut end_of_word = None;
        for item in items {
            let token = match item {
                Item::Break => {
                    reading.script.breaks.push(reading.script.words.len());
                    continue;
                }
                Item::Token(token) => token,
            };
            let is_kana = token.kind == TokenKind::Word && kana::is_kana(&token.text);
            let is_behind_word = is_kana && end_of_word.is_some_and(|end| is_beside(text, end, token.range.start));
            end_of_word = (!is_kana).then_some(token.range.end);
            let pronunciations = match &token.kind {
                TokenKind::Word if is_behind_word && self.lexicon.find(&token.text).is_empty() => {
                    kana::pronounce_behind_word(&token.text)
                }
                TokenKind::Word => match seen.get(&token.text) {
                    Some(known) => known.clone(),
                    None => seen.entry(token.text.clone()).or_insert(self.pronounce(&token.text)).clone(),
                },
                TokenKind::Stutter(whole) => stutter::pronounce(self, &token.text, whole),
                TokenKind::Spelled(readings) => match self.lexicon.find(&token.text) {
                    [] => self.spelled(readings),
                    own => with_origin(own.to_vec(), Origin::Lexicon),
                },
                TokenKind::Say(say) => match said::phones(self, &say.how) {
                    Ok(all) => with_origin(all, Origin::Say),
                    Err(range) => {
                        let range = say.range.start + range.start..say.range.start + range.end;
                        reading.problems.push(Problem { kind: ProblemKind::UnknownPhone, range });
                        self.pronounce(&token.text)
                    }
                },
            };
            if token.kind == TokenKind::Word && word::needs_reading(self, &token.text, &pronunciations) {
                reading.problems.push(Problem { kind: ProblemKind::NoReading, range: token.range.clone() });
            }
            let Token { text, range, .. } = token;
            reading.script.words.push(Word { text, range, pronunciations });
        }
        if let Some(table) = rules::table(self.language.code()).filter(|table| !table.links.is_empty()) {
            link::link(text, &mut reading.script.words, table);
        }
        reading.problems.sort_by_key(|problem| problem.range.start);
        reading
    }

    /// Returns all pronunciations of one word, the most likely first; empty if it has no letters that could be spoken.
    pub fn pronounce(&self, word: &str) -> Vec<Pronunciation> {
        let own = self.lexicon.find(word);
        if !own.is_empty() {
            return with_origin(own.to_vec(), Origin::Lexicon);
        }
        word::pronounce(self.language, word)
    }

    /// Returns the pronunciations of a number or sign, from its readings in words.
    fn spelled(&self, readings: &[String]) -> Vec<Pronunciation> {
        let mut all: Vec<Pronunciation> = Vec::new();
        for reading in readings {
            let (parts, origin) = said::words(self, reading);
            for phones in variants::sequence(&parts) {
                if all.len() < variants::MOST && all.iter().all(|known| known.phones != phones) {
                    all.push(Pronunciation { phones, origin });
                }
            }
        }
        all
    }

    /// Returns the context for dividing a text into words.
    fn context(&self) -> OwnedContext<'_> {
        OwnedContext {
            japanese: self.language.code() == "ja",
            longest_entry: self.lexicon.longest(),
            entry: Box::new(|words| !self.lexicon.find(words).is_empty()),
            known: Box::new(|word| !self.lexicon.find(word).is_empty() || word::knows(self.language, word)),
            spelled: Box::new(|text, at| numbers::spelled(self.language.code(), text, at)),
        }
    }
}

/// Whether only `{…}`, which are not displayed, are between two positions of a text.
fn is_beside(text: &str, end: usize, start: usize) -> bool {
    let between = text.get(end..start).unwrap_or_default();
    between.is_empty() || between.trim_start().starts_with('{') && between.ends_with('}') && !between.contains("} ")
}

type WordTest<'p> = Box<dyn Fn(&str) -> bool + 'p>;
type SpellingLookup<'p> = Box<dyn Fn(&str, usize) -> Option<Spelling> + 'p>;

/// A [`Context`] with the values that it borrows.
struct OwnedContext<'p> {
    japanese: bool,
    longest_entry: usize,
    entry: WordTest<'p>,
    known: WordTest<'p>,
    spelled: SpellingLookup<'p>,
}

impl OwnedContext<'_> {
    fn borrow(&self) -> Context<'_> {
        Context {
            japanese: self.japanese,
            longest_entry: self.longest_entry,
            entry: &*self.entry,
            known: &*self.known,
            spelled: &*self.spelled,
        }
    }
}

fn with_origin(all: Vec<Vec<crate::Phone>>, origin: Origin) -> Vec<Pronunciation> {
    all.into_iter().map(|phones| Pronunciation { phones, origin }).collect()
}
