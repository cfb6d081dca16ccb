//! Translations of texts rather than of clips: those of a game that has been translated before, or a compendium.

use super::keys::is_foreign;
use crate::exchange::Entry;
use crate::exchange::clip_texts::{strings, trimmed};
use crate::exchange::model::joined;
use lipz_diagnostics::{Code, Diagnostic, Span, bound, escape};
use lipz_file::Document;
use lipz_file::locale::is_variant;
use std::collections::btree_map::Entry as Slot;
use std::collections::{BTreeMap, BTreeSet};

/// The translations of texts, whatever clip they are in, for [`Merge::merge`](super::Merge::merge).
#[derive(Debug)]
pub struct TextTranslations<'e> {
    /// By source text and locale: the translation, or `None` if there are different ones.
    known: BTreeMap<(String, &'e str), Option<&'e Entry>>,
    /// The locales of these translations.
    locales: BTreeSet<&'e str>,
}

impl<'e> TextTranslations<'e> {
    /// Returns the translations of the entries that do not belong to one of the clips with these `keys`, and reports texts
    /// with different translations, with the number of the file. None of these is used.
    pub fn new(entries: &'e [Entry], keys: &BTreeSet<&str>) -> (TextTranslations<'e>, Vec<(usize, Diagnostic)>) {
        let mut known: BTreeMap<(String, &str), Option<&Entry>> = BTreeMap::new();
        let mut found = Vec::new();
        let is_usable = |entry: &&Entry| is_foreign(entry, keys) && !entry.text.text.trim().is_empty();
        for entry in entries.iter().filter(is_usable) {
            if is_variant(&entry.locale) {
                let message = "a plural form or other variant does not belong to a clip, and is not imported";
                found.push((entry.file, Diagnostic::at(Code::UnknownTextKey, entry.text.span, message)));
                bound::limit_many_of_files(&mut found);
                continue;
            }
            let Some(source) = entry.source.as_ref().map(|source| joined(&trimmed(&source.text))) else { continue };
            match known.entry((source, &*entry.locale)) {
                Slot::Vacant(slot) => drop(slot.insert(Some(entry))),
                Slot::Occupied(mut slot) => {
                    let is_other = |known: &&Entry| trimmed(&known.text.text) != trimmed(&entry.text.text);
                    if slot.get().as_ref().is_some_and(is_other) {
                        let message = format!("{} has different translations", escape::quoted(&slot.key().0));
                        let diagnostic = Diagnostic::at(Code::TextConflict, entry.text.span, message);
                        found.push((entry.file, diagnostic.help("delete all but one; none of them is imported")));
                        slot.insert(None);
                    }
                }
            }
        }
        let locales = known.keys().map(|(_, locale)| *locale).collect();
        (TextTranslations { known, locales }, found)
    }

    /// Reports, by file, the translations that are not among `used`, the entries of [`of_clip`](Self::of_clip).
    pub fn unused<'u>(&self, used: impl IntoIterator<Item = &'u Entry>) -> Vec<(usize, Diagnostic)> {
        let place = |entry: &Entry| (entry.file, entry.text.span);
        let used: BTreeSet<(usize, Span)> = used.into_iter().map(place).collect();
        let mut unused: BTreeMap<usize, (usize, Span)> = BTreeMap::new();
        for (file, span) in
            self.known.values().flatten().map(|entry| place(entry)).filter(|place| !used.contains(place))
        {
            let (count, first) = unused.entry(file).or_insert((0, span));
            *count += 1;
            *first = span.min(*first);
        }
        let report = |(file, (count, span)): (usize, (usize, Span))| {
            let message = match count {
                1 => "a translation matches no text that lacks one, and is not imported".to_owned(),
                _ => format!("{count} translations match no text that lacks one, and are not imported"),
            };
            (file, Diagnostic::at(Code::UnknownTextKey, span, message))
        };
        unused.into_iter().map(report).collect()
    }

    /// Returns entries for the texts of a clip that have no translation yet. `entries` are those for the clip itself.
    pub fn of_clip(
        &self,
        key: &str,
        clip: &Document<'_>,
        (source_locale, default_locale): (&str, Option<&str>),
        entries: &[&Entry],
    ) -> Vec<Entry> {
        let strings = strings(clip, default_locale);
        let Some(sources) = strings.get(source_locale).map(|string| trimmed(&string.text)) else { return Vec::new() };
        let mut found = Vec::new();
        for &locale in &self.locales {
            if entries.iter().any(|entry| &*entry.locale == locale && !entry.text.text.is_empty()) {
                continue;
            }
            let own = strings.get(locale).map(|string| trimmed(&string.text)).unwrap_or_default();
            let translation = |source: String| self.known.get(&(source, locale)).copied().flatten();
            let of_key = |entry: &Entry, segment: Option<usize>| {
                let mut key_words = (*entry.key).clone();
                key.clone_into(&mut key_words.text);
                Entry { key: key_words.into(), segment, segment_count: None, mark: None, ..entry.clone() }
            };
            if own.iter().all(String::is_empty)
                && let Some(entry) = translation(joined(&sources))
            {
                found.push(of_key(entry, None));
                continue;
            }
            for (at, source) in sources.iter().enumerate().filter(|(_, source)| !source.is_empty()) {
                let is_missing = own.get(at).is_none_or(String::is_empty);
                if let Some(entry) = translation(source.clone()).filter(|_| is_missing) {
                    found.push(of_key(entry, Some(at + 1)));
                }
            }
        }
        found
    }
}
