//! Merging: inserts translations of an exchange file into the Lipz file, and changes nothing else there.

mod by_text;
mod clip;
mod confirmed;
mod keys;
mod line_ends;
mod options;
mod renamed;
mod results;
mod splice;
mod variant;

pub use by_text::TextTranslations;
pub use keys::{resolve_keys, unknown_keys};
pub use options::Merge;
pub use renamed::follow_renamed_clips;
pub use results::{ConfirmedTranslations, Counts, MergedFile, TranslatorComments};

use crate::exchange::clip_texts::strings;
use crate::exchange::{ClipSources, Entry, Mark, texts_of};
use lipz_diagnostics::{Code, Diagnostic};
use lipz_file::Document;
use lipz_file::format::Style;
use lipz_file::locale::split_variant;
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};

impl Merge<'_> {
    /// Merges entries, all for the clip in `file`, into its text. A locale with an error stays unchanged; all others
    /// are merged.
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
    pub fn merge(&self, file: &str, clip: &Document<'_>, entries: &[&Entry]) -> MergedFile {
        let mut merged = MergedFile::default();
        let mut by_locale: BTreeMap<&str, Vec<&Entry>> = BTreeMap::new();
        for entry in entries {
            by_locale.entry(&entry.locale).or_default().push(entry);
        }
        let strings = strings(clip, self.default_locale);
        let clip_texts = texts_of(clip, self.default_locale);
        let clip_sources = ClipSources::new(&clip_texts, self.source_locale);
        let mut texts = Vec::new();
        // A locale comes before its variants, whose blank segments show its texts.
        let mut imported: BTreeMap<String, Vec<String>> = BTreeMap::new();
        for (locale, entries) in by_locale {
            merged.comments.push(comments(locale, &entries));
            let Some(sources) = clip_sources.as_ref().map(|sources| sources.of(locale)) else {
                let first = entries.first().map(|entry| (entry.file, entry.key.span)).unwrap_or_default();
                let message = format!("the clip has no text in {}, the source of the translation", self.source_locale);
                merged.found.push((first.0, Diagnostic::at(Code::OutdatedSource, first.1, message)));
                merged.counts.refused += 1;
                continue;
            };
            let mut found = Vec::new();
            let own = clip_texts.get(locale).map(Vec::as_slice);
            let (varied, key) = split_variant(locale);
            let whole = key.and_then(|_| clip_texts.get(varied)).map(Vec::as_slice);
            let project = [&*sources.texts, own.unwrap_or_default()];
            let entries = entries.into_iter().map(|entry| line_ends::of_project(entry, &project));
            let mut entries: Vec<_> = entries.collect();
            if key.is_some() {
                let known = [whole, imported.get(varied).map(Vec::as_slice)];
                entries.iter_mut().for_each(|entry| variant::as_in_project(entry, &sources, known));
            }
            let entries: Vec<&Entry> = entries.iter().map(Cow::as_ref).collect();
            let result = clip::merge(self, &sources, [own, whole], &entries, &mut found);
            let sources = &*sources.texts;
            let is_refused = self.report(found, &mut merged.found);
            if !is_refused {
                let now = ConfirmedTranslations::new(locale, sources, own, &result.texts);
                merged.confirmed.extend(confirmed::of_older(now.clone(), &entries, &result.texts));
                merged.confirmed.extend(confirmed::of_entries(now, &entries));
                merged.other_sources.extend(confirmed::other_sources(sources, &entries));
                imported.extend(result.with_texts(own).map(|texts| (locale.to_owned(), texts)));
            }
            let has_own = own.is_some_and(|own| own.iter().any(|text| !text.is_empty()));
            let counts = &mut merged.counts;
            match result {
                _ if is_refused => counts.refused += 1,
                clip::ClipChanges { texts: new, unmarked, .. } if !new.is_empty() => {
                    counts.unmarked += unmarked;
                    *(if has_own { &mut counts.changed } else { &mut counts.added }) += 1;
                    texts.push(splice::NewTexts { locale: locale.to_owned(), segments: new, count: sources.len() });
                }
                result if result.is_newer => counts.newer += 1,
                _ => counts.unchanged += 1,
            }
        }
        let style = Style { default_locale: self.default_locale, ..Style::default() };
        merged.sources = clip_texts.get(self.source_locale).cloned().unwrap_or_default();
        merged.text = (!texts.is_empty()).then(|| splice::splice(file, clip, &texts, style, &strings));
        merged
    }

    /// Adds diagnostics at the levels of the project. Returns whether one of them is an error.
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

/// Returns the comments of the entries, each once. If some copies of a file have changed comments, only theirs count.
fn comments(locale: &str, entries: &[&Entry]) -> TranslatorComments {
    let exported = entries.iter().find_map(|entry| entry.comments_mark);
    let is_changed =
        |entry: &&&Entry| entry.comments_mark.is_none_or(|mark| mark != Mark::of_comments(&entry.comments));
    let has_changed = entries.iter().any(|entry| is_changed(&entry) && entry.comments_mark.is_some());
    let entries = entries.iter().filter(|entry| !has_changed || is_changed(entry));
    let (mut lines, mut known) = (Vec::new(), BTreeSet::new());
    lines.extend(entries.flat_map(|entry| &entry.comments).filter(|line| known.insert(*line)).cloned());
    TranslatorComments { locale: locale.to_owned(), lines, exported }
}
