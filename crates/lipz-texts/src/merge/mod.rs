//! Merging: translations of a file of exchange come into the Lipz file, and nothing else changes there.

mod confirmed;
mod keys;
mod line_ends;
mod one;
mod splice;

pub use keys::unknown_keys;

use crate::collect::{strings, trimmed};
use crate::{Entry, State};
use lipz_diagnostics::{Code, Diagnostic, Levels, Span};
use lipz_file::Document;
use lipz_file::format::Style;
use lipz_file::locale::{TextName, text_name};
use std::borrow::Cow;
use std::collections::BTreeMap;

/// How translations come into Lipz files.
#[derive(Clone, PartialEq, Debug)]
pub struct Merge<'a> {
    source_locale: &'a str,
    default_locale: Option<&'a str>,
    min_state: State,
    is_forced: bool,
    levels: Levels,
}

/// A Lipz file with translations.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
#[non_exhaustive]
pub struct Merged {
    /// The new text of the file; `None` if nothing changes.
    pub text: Option<String>,
    /// What does not fit, with the number of the file of exchange in which it is.
    pub found: Vec<(usize, Diagnostic)>,
    /// What became of the texts.
    pub counts: Counts,
    /// What the translations are made from that the file vouches for, imported or as they were.
    pub confirmed: Vec<Confirmed>,
    /// Source texts of the file that are others than those of the clip, with the number of the file. They are never imported.
    pub other_sources: Vec<(usize, Span)>,
}

/// Translations of a clip into a locale that were made from these source texts, as a file of exchange says: those of today, or
/// older ones whose translations were imported all the same.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Confirmed {
    /// The locale of the translations.
    pub locale: String,
    /// The source texts of the segments.
    pub sources: Vec<String>,
    /// Their translations, as they are after the import.
    pub texts: Vec<String>,
    /// Of each segment, how far the work is; `None` if the file says nothing about it.
    pub states: Vec<Option<State>>,
    /// Whether somebody has changed the text of the segment in the file, or the file says of each text how far it is.
    /// Others may only be new to the project's [record](crate::TextRecord): nobody may have looked at them.
    pub is_looked_at: Vec<bool>,
}

/// What became of the texts of a file of exchange: of clips in a locale.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
#[non_exhaustive]
pub struct Counts {
    /// Clips that had no text in the locale.
    pub added: usize,
    /// Clips whose text changed.
    pub changed: usize,
    /// Clips whose text is as the file has it.
    pub unchanged: usize,
    /// Clips that have another text since the export, which nobody changed in the file: it stays.
    pub newer: usize,
    /// Clips to which something does not fit: they stay as they are.
    pub refused: usize,
    /// Texts that were replaced without a mark that says what they were at the export.
    pub unmarked: usize,
}

impl Counts {
    /// Adds others.
    pub fn add(&mut self, others: Counts) {
        self.added += others.added;
        self.changed += others.changed;
        self.unchanged += others.unchanged;
        self.newer += others.newer;
        self.refused += others.refused;
        self.unmarked += others.unmarked;
    }
}

impl<'a> Merge<'a> {
    /// Translations from this locale.
    pub fn new(source_locale: &'a str) -> Merge<'a> {
        let levels = Levels::default();
        Merge { source_locale, default_locale: None, min_state: State::Translated, is_forced: false, levels }
    }

    /// Sets the locale of `text` without a locale, which is also the first one in the layout.
    #[must_use]
    pub fn default_locale(self, locale: Option<&'a str>) -> Self {
        Merge { default_locale: locale, ..self }
    }

    /// Sets the state that a translation must have reached.
    #[must_use]
    pub fn min_state(self, min_state: State) -> Self {
        Merge { min_state, ..self }
    }

    /// Sets whether translations are taken of texts that changed since the export.
    #[must_use]
    pub fn forced(self, is_forced: bool) -> Self {
        Merge { is_forced, ..self }
    }

    /// Sets the levels of lints: what a project makes an error is not imported.
    #[must_use]
    pub fn levels(self, levels: &Levels) -> Self {
        Merge { levels: levels.clone(), ..self }
    }

    /// Brings entries, all of the clip that is in `file`, into its text. A locale in which something is wrong stays as it
    /// is, all others are merged.
    ///
    /// ```
    /// use lipz_texts::{Merge, ReadOptions, Format, read};
    /// let po = b"msgid \"\"\nmsgstr \"Language: de_DE\\n\"\n\nmsgctxt \"mara\"\nmsgid \"Hi. | You?\"\nmsgstr \"Hallo. | Du?\"\n";
    /// let read = read(Format::Po, po, &ReadOptions::new("en-us"));
    /// let file = r#"{ "visemes": "MA|EO", "text_en-us": "Hi.|You?" }"#;
    /// let clip = lipz_file::parse(file.as_bytes()).document.ok_or("a valid file")?;
    /// let merged = Merge::new("en-us").merge(file, &clip, &read.entries.iter().collect::<Vec<_>>());
    /// let expected = r#"{ "visemes": "MA|EO", "text_en-us": "Hi.|You?", "text_de-de": "Hallo.|Du?" }"#;
    /// assert_eq!(merged.text.as_deref(), Some(expected));
    /// # Ok::<(), &str>(())
    /// ```
    pub fn merge(&self, file: &str, clip: &Document<'_>, entries: &[&Entry]) -> Merged {
        let mut merged = Merged::default();
        let mut by_locale: BTreeMap<&str, Vec<&Entry>> = BTreeMap::new();
        for entry in entries {
            by_locale.entry(&entry.locale).or_default().push(entry);
        }
        let strings = strings(clip, self.default_locale);
        let trimmed = |locale: &str| strings.get(locale).map(|string| trimmed(&string.text));
        let sources = trimmed(self.source_locale);
        let mut texts = Vec::new();
        for (locale, entries) in by_locale {
            let Some(sources) = &sources else {
                let first = entries.first().map(|entry| (entry.file, entry.key.span)).unwrap_or_default();
                let message = format!("the clip has no text in {}, from which this was translated", self.source_locale);
                merged.found.push((first.0, Diagnostic::at(Code::OutdatedSource, first.1, message)));
                merged.counts.refused += 1;
                continue;
            };
            let mut found = Vec::new();
            let own = trimmed(locale);
            let project = [sources.as_slice(), own.as_deref().unwrap_or_default()];
            let entries: Vec<_> = entries.into_iter().map(|entry| line_ends::of_project(entry, &project)).collect();
            let entries: Vec<&Entry> = entries.iter().map(Cow::as_ref).collect();
            let result = one::merge(self, sources, own.as_deref(), &entries, &mut found);
            let is_refused = self.report(found, &mut merged.found);
            if !is_refused {
                let now = Confirmed::new(locale, sources, own.as_deref(), &result.texts);
                merged.confirmed.extend(confirmed::of_older(now.clone(), &entries, &result.texts));
                merged.confirmed.extend(confirmed::of_entries(now, &entries));
                merged.other_sources.extend(confirmed::other_sources(sources, &entries));
            }
            let has_own = own.is_some_and(|own| own.iter().any(|text| !text.is_empty()));
            let counts = &mut merged.counts;
            match result {
                _ if is_refused => counts.refused += 1,
                one::Result { texts: new, unmarked, .. } if !new.is_empty() => {
                    counts.unmarked += unmarked;
                    *(if has_own { &mut counts.changed } else { &mut counts.added }) += 1;
                    texts.push(splice::Text { locale: locale.to_owned(), segments: new, count: sources.len() });
                }
                result if result.is_newer => counts.newer += 1,
                _ => counts.unchanged += 1,
            }
        }
        let style = Style { default_locale: self.default_locale, ..Style::default() };
        merged.text = (!texts.is_empty()).then(|| splice::splice(file, clip, &texts, style, &strings));
        merged
    }

    /// Adds what was found, at the levels of the project; whether an error is among it.
    fn report(&self, found: Vec<(usize, Diagnostic)>, all: &mut Vec<(usize, Diagnostic)>) -> bool {
        let mut is_refused = false;
        for (file, diagnostic) in found {
            let mut one = vec![diagnostic];
            self.levels.apply(&mut one);
            is_refused |= one.iter().any(Diagnostic::is_error);
            all.extend(one.into_iter().map(|diagnostic| (file, diagnostic)));
        }
        is_refused
    }
}

/// The locale of a text by the name of its element.
pub(crate) fn tag_of(name: &str, default_locale: Option<&str>) -> Option<String> {
    match text_name(name)? {
        TextName::Canonical(tag) | TextName::Misspelt(tag) | TextName::OtherShape(_, Some(tag)) => Some(tag),
        TextName::NoLocale => default_locale.map(str::to_owned),
        TextName::OtherShape(_, None) => None,
    }
}
