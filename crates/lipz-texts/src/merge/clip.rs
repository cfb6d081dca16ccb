//! The entries of one clip in one locale: changed segments, and conflicts.

use super::Merge;
use crate::exchange::clip_texts::trimmed;
use crate::exchange::model::{State, joined};
use crate::exchange::{Entry, Mark, SourceTexts, markup, placeholder};
use lipz_diagnostics::{Code, Diagnostic, Span, bound, escape};
use lipz_file::text::{DELIMITER, trim};
use std::collections::BTreeMap;

/// The changes of a clip in one locale.
#[derive(Default)]
pub(super) struct ClipChanges {
    /// The changed segments, from 0, with their texts.
    pub(super) texts: BTreeMap<usize, String>,
    /// The number of replaced texts without a mark in the file.
    pub(super) unmarked: usize,
    /// Whether the project has newer work than the file.
    pub(super) is_newer: bool,
}

impl ClipChanges {
    /// Returns the texts of the locale after the import; `None` if it has none.
    pub(super) fn with_texts(&self, own: Option<&[String]>) -> Option<Vec<String>> {
        let count = self.texts.keys().next_back().map_or(0, |last| last + 1);
        let mut texts = own.map_or_else(Vec::new, <[String]>::to_vec);
        texts.resize(texts.len().max(count), String::new());
        for (at, text) in &self.texts {
            texts.get_mut(*at).into_iter().for_each(|slot| slot.clone_from(text));
        }
        Some(texts).filter(|texts| !texts.is_empty())
    }
}

/// Diagnostics, with the number of the file.
type NumberedDiagnostics = Vec<(usize, Diagnostic)>;

/// Merges the entries. `from` has the current source texts, `own` those of the locale, and `whole`
/// those that a variant varies.
pub(super) fn merge(
    merge: &Merge<'_>,
    from: &SourceTexts<'_>,
    [own, whole]: [Option<&[String]>; 2],
    entries: &[&Entry],
    found: &mut NumberedDiagnostics,
) -> ClipChanges {
    let mut result = ClipChanges::default();
    let sources = &*from.texts;
    if let (Some(own), Some(first)) = (own, entries.first())
        && own.len() != sources.len()
    {
        let (locale, has, source, needs) = (&first.locale, own.len(), merge.source_locale, sources.len());
        let message =
            format!("the project's text in {locale} has {has} segments, but its text in {source} has {needs}");
        let diagnostic = Diagnostic::at(Code::TextSegments, first.key.span, message);
        found.push((first.file, diagnostic.help("fix the Lipz file first")));
        return result;
    }
    let empty = vec![String::new(); sources.len()];
    let clip = ClipMerge { merge, from, whole: whole.unwrap_or_default(), sources, own: own.unwrap_or(&empty) };
    let mut places: BTreeMap<usize, (&Entry, String)> = BTreeMap::new();
    for entry in entries {
        let Some(parts) = clip.parts(entry, found) else { continue };
        // An untranslated entry does not count as an alternative translation.
        let is_translation = !entry.text.text.is_empty() || entry.mark.is_some();
        // Nor does a text that was not changed in a copy of the file, or that the project has already.
        let is_exported = entry.mark == Some(mark_of(&parts));
        let is_new = |(at, text): &(usize, String)| clip.own.get(*at) != Some(text);
        for (at, text) in parts.into_iter().filter(|_| is_translation && !is_exported).filter(is_new) {
            match places.get(&at) {
                Some((_, other)) if *other != text => found.push((entry.file, twice(entry))),
                Some(_) => continue,
                None => {}
            }
            places.insert(at, (entry, text.clone()));
        }
        clip.entry(entry, &mut result, found);
        bound::limit_many_of_files(found);
    }
    result
}

fn twice(entry: &Entry) -> Diagnostic {
    let message = format!("{} has a different text earlier in the file", escape::quoted(&entry.key.text));
    Diagnostic::at(Code::TextConflict, entry.text.span, message).help("delete one of the two")
}

struct ClipMerge<'m> {
    merge: &'m Merge<'m>,
    from: &'m SourceTexts<'m>,
    /// For a variant, the texts that it varies. A blank segment stands for theirs.
    whole: &'m [String],
    sources: &'m [String],
    own: &'m [String],
}

impl ClipMerge<'_> {
    /// Returns the segments of an entry, from 0, with their texts; `None` if they do not fit.
    fn parts(&self, entry: &Entry, found: &mut NumberedDiagnostics) -> Option<Vec<(usize, String)>> {
        let count = self.sources.len();
        if let Some(number) = entry.segment {
            let text = trim(&entry.text.text);
            let is_other = entry.segment_count.is_some_and(|of| of != count);
            if number > count || is_other {
                let segments = if count == 1 { "segment" } else { "segments" };
                let message =
                    format!("the file has a text for segment {number}, but the clip now has {count} {segments}");
                self.refuse(entry, Code::TextSegments, entry.key.span, &message, "export the clip again", found);
                return None;
            }
            if let Some(at) = text.find(DELIMITER) {
                let message = format!("`{DELIMITER}` in the text would split the segment");
                let span = near(entry, at);
                self.refuse(entry, Code::TextSegments, span, &message, "delete it; the text is for one segment", found);
                return None;
            }
            return Some(vec![(number - 1, self.to_store(number - 1, text))]);
        }
        let texts = trimmed(&entry.text.text);
        if texts.iter().all(String::is_empty) {
            return Some((0..count).map(|at| (at, String::new())).collect());
        }
        // For a clip that has changed since, the entry's own source determines the number of segments.
        let expected = entry.source.as_ref().map_or(count, |source| trimmed(&source.text).len());
        if texts.len() != expected {
            let (has, needs) = (texts.len() - 1, expected - 1);
            let message = format!("the translation has {has} `{DELIMITER}`, but its source has {needs}");
            let help = "put a `|` where segments meet, as often as in the source";
            self.refuse(entry, Code::TextSegments, entry.text.span, &message, help, found);
            return None;
        }
        Some(texts.iter().enumerate().map(|(at, text)| (at, self.to_store(at, text))).collect())
    }

    /// Returns the text of a segment: the project's, if it is spelled out there, but left blank in the file of a variant.
    fn to_store(&self, at: usize, text: &str) -> String {
        let own = self.own.get(at).filter(|own| text.is_empty() && self.whole.get(at) == Some(own));
        own.map_or(text, String::as_str).to_owned()
    }

    /// Applies the texts of an entry, unless there is a conflict.
    fn entry(&self, entry: &Entry, result: &mut ClipChanges, found: &mut NumberedDiagnostics) {
        let Some(parts) = self.parts(entry, &mut Vec::new()) else { return };
        let old = |at: usize| self.own.get(at).map_or("", String::as_str);
        let changes = || parts.iter().filter(|(at, text)| *text != old(*at));
        if changes().next().is_none() {
            return;
        }
        let of = |texts: &[String]| match entry.segment {
            Some(number) => texts.get(number - 1).cloned().unwrap_or_default(),
            None => joined(texts),
        };
        if entry.mark == Some(mark_of(&parts)) {
            // The text was not changed in the file.
            result.is_newer = true;
            return;
        }
        if parts.iter().all(|(_, text)| text.is_empty()) {
            // A missing text without a mark never was in the file. With a mark, it was deleted there.
            match entry.mark {
                Some(_) => changes().for_each(|(at, _)| found.push(self.missing(entry, *at))),
                None => result.is_newer = true,
            }
            return;
        }
        if entry.state < self.merge.min_state {
            let message = format!("the translation is {} and is not imported", self.unfinished(entry.state));
            found.push((entry.file, Diagnostic::at(Code::UnfinishedTranslation, entry.text.span, message)));
            return;
        }
        let own = of(self.own);
        // The file has the mark of its export. Its own earlier version may have been imported since.
        let is_imported = changes().all(|(at, _)| self.merge.is_imported(&entry.locale, old(*at)));
        let is_other = entry.mark.is_some_and(|mark| mark != Mark::of(&own));
        if is_other && !is_imported && !self.merge.is_forced {
            let diagnostic = Diagnostic::at(
                Code::TextConflict,
                entry.text.span,
                "the text has also changed in the project since the export",
            )
            .note(format!("the project has {}", escape::quoted(&own)))
            .help("merge both by hand, or export the clip again and translate it");
            found.push((entry.file, diagnostic));
            return;
        }
        if let Some(diagnostic) = self.outdated(entry, &of(self.sources)) {
            found.push((entry.file, diagnostic));
            if !self.merge.is_forced {
                return;
            }
        }
        for (at, text) in changes() {
            self.segment(entry, (*at, text), old(*at), result, found);
        }
    }

    /// Applies the text of one segment, which differs.
    fn segment(
        &self,
        entry: &Entry,
        (at, text): (usize, &str),
        old: &str,
        result: &mut ClipChanges,
        found: &mut NumberedDiagnostics,
    ) {
        // A translator may leave out what a variant has besides the segments that vary.
        let is_left_out = entry.segment.is_none() && entry.mark.is_some() && !self.whole.is_empty();
        if text.is_empty() && is_left_out && self.sources.get(at).is_some_and(String::is_empty) {
            result.texts.insert(at, String::new());
            return;
        }
        if text.is_empty() {
            found.push(self.missing(entry, at));
            return;
        }
        let source = self.sources.get(at).map_or("", String::as_str);
        if let Some(message) = self.from.placeholder_difference(at, text, self.merge.placeholders) {
            let diagnostic = Diagnostic::at(Code::Placeholder, entry.text.span, message);
            found.push((entry.file, diagnostic.help(placeholder::HELP)));
        }
        if let Some(message) = placeholder::meta_difference(source, text) {
            let diagnostic = Diagnostic::at(Code::MetaDiffers, entry.text.span, message);
            found.push((entry.file, diagnostic.help(placeholder::META_HELP)));
        }
        if let Some(message) = markup::difference(source, text) {
            let diagnostic = Diagnostic::at(Code::MarkupDiffers, entry.text.span, message);
            found.push((entry.file, diagnostic.help(markup::HELP)));
        }
        let is_first = result.texts.insert(at, text.to_owned()).is_none();
        result.unmarked += usize::from(is_first && !old.is_empty() && entry.mark.is_none());
    }

    /// Returns the diagnostic for a segment whose text is in the project, but missing from the file.
    fn missing(&self, entry: &Entry, at: usize) -> (usize, Diagnostic) {
        let message = format!("segment {} has no translation in the file, so the project keeps its own", at + 1);
        let diagnostic = Diagnostic::at(Code::UnfinishedTranslation, entry.text.span, message);
        let own = self.own.get(at).map_or("", String::as_str);
        (entry.file, diagnostic.note(format!("the project has {}", escape::quoted(own))))
    }

    /// Returns the diagnostic for a source that has changed in the project.
    fn outdated(&self, entry: &Entry, now: &str) -> Option<Diagnostic> {
        let (span, then) = match (&entry.source, entry.source_mark) {
            (Some(source), _) => {
                let then = match entry.segment {
                    Some(_) => trim(&source.text).to_owned(),
                    None => joined(&trimmed(&source.text)),
                };
                (source.span, Some(then).filter(|then| then != now)?)
            }
            (None, Some(mark)) if !mark.is_of(now) => (entry.text.span, String::new()),
            _ => return None,
        };
        let mut diagnostic = Diagnostic::at(Code::OutdatedSource, span, "the translation was made from an older text");
        if self.merge.is_forced {
            diagnostic.severity = lipz_diagnostics::Severity::Warning;
        }
        if !then.is_empty() {
            diagnostic = diagnostic.note(format!("it was made from {}", escape::quoted(&then)));
        }
        Some(
            diagnostic
                .note(format!("the project has {}", escape::quoted(now)))
                .help("translate the new text, or export the clip again"),
        )
    }

    fn refuse(
        &self,
        entry: &Entry,
        code: Code,
        span: Span,
        message: &str,
        help: &str,
        found: &mut NumberedDiagnostics,
    ) {
        found.push((entry.file, Diagnostic::at(code, span, message).help(help)));
    }

    fn unfinished(&self, state: State) -> String {
        match state {
            State::Initial => "marked for review (fuzzy)".to_owned(),
            state => format!("only {state}"),
        }
    }
}

/// Returns the mark of these segments.
pub(super) fn mark_of(parts: &[(usize, String)]) -> Mark {
    Mark::of(&joined(&parts.iter().map(|(_, text)| text.as_str()).collect::<Vec<_>>()))
}

/// Returns the character at byte `at` of a text if it is spelled literally in the file, otherwise the whole text.
fn near(entry: &Entry, at: usize) -> Span {
    let span = entry.text.span;
    let at = at + entry.text.text.len() - entry.text.text.trim_start().len();
    if span.range().len() == entry.text.text.len() {
        let start = span.range().start + at;
        return Span::new(start, start + 1);
    }
    span
}
