//! The entries of one clip in one locale: which segments change, and what does not fit.

use super::Merge;
use crate::collect::trimmed;
use crate::model::joined;
use crate::placeholder;
use crate::{Entry, Mark, State};
use lipz_diagnostics::{Code, Diagnostic, Span, escape};
use lipz_file::text::{DELIMITER, trim};
use std::collections::BTreeMap;

/// What a locale of a clip gets.
#[derive(Default)]
pub(super) struct Result {
    /// Segments that change, from 0, and their texts.
    pub(super) texts: BTreeMap<usize, String>,
    /// How many texts are replaced of which the file does not say what they were.
    pub(super) unmarked: usize,
    /// Whether the project has newer work than the file.
    pub(super) is_newer: bool,
}

/// What is found, with the number of the file.
type Found = Vec<(usize, Diagnostic)>;

/// `sources` are the texts of today to be translated, `own` those of the locale.
pub(super) fn merge(
    merge: &Merge<'_>,
    sources: &[String],
    own: Option<&[String]>,
    entries: &[&Entry],
    found: &mut Found,
) -> Result {
    let mut result = Result::default();
    if let (Some(own), Some(first)) = (own, entries.first())
        && own.len() != sources.len()
    {
        let (locale, has, source, needs) = (&first.locale, own.len(), merge.source_locale, sources.len());
        let message = format!("the project's text in {locale} has {has} segments, that in {source} has {needs}");
        let diagnostic = Diagnostic::at(Code::TextSegments, first.key.span, message);
        found.push((first.file, diagnostic.help("mend the Lipz file first")));
        return result;
    }
    let empty = vec![String::new(); sources.len()];
    let clip = Clip { merge, sources, own: own.unwrap_or(&empty) };
    let mut places: BTreeMap<usize, (&Entry, String)> = BTreeMap::new();
    for entry in entries {
        let Some(parts) = clip.parts(entry, found) else { continue };
        // What is not translated is no other translation.
        let is_translation = !entry.text.text.is_empty() || entry.mark.is_some();
        for (at, text) in parts.into_iter().filter(|_| is_translation) {
            match places.get(&at) {
                Some((_, other)) if *other != text => found.push((entry.file, twice(entry))),
                Some(_) => continue,
                None => {}
            }
            places.insert(at, (entry, text.clone()));
        }
        clip.entry(entry, &mut result, found);
    }
    result
}

fn twice(entry: &Entry) -> Diagnostic {
    let message = format!("{} has another text before", escape::quoted(&entry.key.text));
    Diagnostic::at(Code::TextConflict, entry.text.span, message).help("delete one of the two")
}

struct Clip<'m> {
    merge: &'m Merge<'m>,
    sources: &'m [String],
    own: &'m [String],
}

impl Clip<'_> {
    /// The segments that an entry is about, from 0, with their texts; `None` if they do not fit.
    fn parts(&self, entry: &Entry, found: &mut Found) -> Option<Vec<(usize, String)>> {
        let count = self.sources.len();
        if let Some(number) = entry.segment {
            let text = trim(&entry.text.text);
            let is_other = entry.segment_count.is_some_and(|of| of != count);
            if number > count || is_other {
                let segments = if count == 1 { "segment" } else { "segments" };
                let message =
                    format!("the file has a text of segment {number}, and the clip has {count} {segments} now");
                self.refuse(entry, Code::TextSegments, entry.key.span, &message, "export the clip again", found);
                return None;
            }
            if let Some(at) = text.find(DELIMITER) {
                let message = format!("`{DELIMITER}` in the text would divide the segment");
                let span = near(entry, at);
                self.refuse(entry, Code::TextSegments, span, &message, "delete it: the text is of one segment", found);
                return None;
            }
            return Some(vec![(number - 1, text.to_owned())]);
        }
        let texts = trimmed(&entry.text.text);
        if texts.iter().all(String::is_empty) {
            return Some((0..count).map(|at| (at, String::new())).collect());
        }
        // Of a clip that changed since, its own source says how many there should be.
        let expected = entry.source.as_ref().map_or(count, |source| trimmed(&source.text).len());
        if texts.len() != expected {
            let (has, needs) = (texts.len() - 1, expected - 1);
            let message = format!("the translation has {has} `{DELIMITER}`, its source has {needs}");
            let help = "`|` separates segments: the translation needs it where they meet, as often as its source";
            self.refuse(entry, Code::TextSegments, entry.text.span, &message, help, found);
            return None;
        }
        Some(texts.into_iter().enumerate().collect())
    }

    /// Takes the texts of an entry, unless something does not fit.
    fn entry(&self, entry: &Entry, result: &mut Result, found: &mut Found) {
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
        let text = joined(&parts.iter().map(|(_, text)| text.as_str()).collect::<Vec<_>>());
        if entry.mark == Some(Mark::of(&text)) {
            // Nobody changed it in the file.
            result.is_newer = true;
            return;
        }
        if text.is_empty() {
            // A translation that was never in the file is no loss; one that was, somebody has deleted.
            match entry.mark {
                Some(_) => changes().for_each(|(at, _)| found.push(self.missing(entry, *at))),
                None => result.is_newer = true,
            }
            return;
        }
        if entry.state < self.merge.min_state {
            let message = format!("the translation is {}, and is not imported", self.unfinished(entry.state));
            found.push((entry.file, Diagnostic::at(Code::UnfinishedTranslation, entry.text.span, message)));
            return;
        }
        let own = of(self.own);
        if entry.mark.is_some_and(|mark| mark != Mark::of(&own)) && !self.merge.is_forced {
            let diagnostic = Diagnostic::at(
                Code::TextConflict,
                entry.text.span,
                "the text also changed in the project since the export",
            )
            .note(format!("the project has {}", escape::quoted(&own)))
            .help("bring both together by hand, or export again and translate that");
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

    /// Takes the text of one segment, which differs.
    fn segment(&self, entry: &Entry, (at, text): (usize, &str), old: &str, result: &mut Result, found: &mut Found) {
        if text.is_empty() {
            found.push(self.missing(entry, at));
            return;
        }
        let source = self.sources.get(at).map_or("", String::as_str);
        if let Some(message) = placeholder::difference(source, text) {
            let diagnostic = Diagnostic::at(Code::Placeholder, entry.text.span, message);
            found.push((entry.file, diagnostic.help(placeholder::HELP)));
        }
        if let Some(message) = placeholder::meta_difference(source, text) {
            let diagnostic = Diagnostic::at(Code::MetaDiffers, entry.text.span, message);
            found.push((entry.file, diagnostic.help(placeholder::META_HELP)));
        }
        result.unmarked += usize::from(!old.is_empty() && entry.mark.is_none());
        result.texts.insert(at, text.to_owned());
    }

    /// What is found about a segment without a text in the file, which has one in the project.
    fn missing(&self, entry: &Entry, at: usize) -> (usize, Diagnostic) {
        let message = format!("segment {} has no translation in the file: that of the project stays", at + 1);
        let diagnostic = Diagnostic::at(Code::UnfinishedTranslation, entry.text.span, message);
        let own = self.own.get(at).map_or("", String::as_str);
        (entry.file, diagnostic.note(format!("the project has {}", escape::quoted(own))))
    }

    /// The diagnostic for a source that is another one in the project.
    fn outdated(&self, entry: &Entry, now: &str) -> Option<Diagnostic> {
        let (span, then) = match (&entry.source, entry.source_mark) {
            (Some(source), _) => {
                let then = match entry.segment {
                    Some(_) => trim(&source.text).to_owned(),
                    None => joined(&trimmed(&source.text)),
                };
                (source.span, Some(then).filter(|then| then != now)?)
            }
            (None, Some(mark)) if mark != Mark::of(now) => (entry.text.span, String::new()),
            _ => return None,
        };
        let mut diagnostic = Diagnostic::at(Code::OutdatedSource, span, "the translation is of an older text");
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

    fn refuse(&self, entry: &Entry, code: Code, span: Span, message: &str, help: &str, found: &mut Found) {
        found.push((entry.file, Diagnostic::at(code, span, message).help(help)));
    }

    fn unfinished(&self, state: State) -> String {
        match state {
            State::Initial => "to be looked at again (fuzzy)".to_owned(),
            state => format!("only {state}"),
        }
    }
}

/// The character at byte `at` of a text, if the file spells the text as it is; otherwise all of the text.
fn near(entry: &Entry, at: usize) -> Span {
    let span = entry.text.span;
    let at = at + entry.text.text.len() - entry.text.text.trim_start().len();
    if span.range().len() == entry.text.text.len() {
        let start = span.range().start + at;
        return Span::new(start, start + 1);
    }
    span
}
