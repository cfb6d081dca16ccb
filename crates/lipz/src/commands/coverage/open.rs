//! Segments to translate, as a document for programs.

use lipz_texts::{LocaleWork, OpenSegment, Progress, SourceMatch, words};
use serde::Serialize;

/// A missing or stale segment.
#[derive(Serialize)]
pub(super) struct OpenRow<'w> {
    key: &'w str,
    /// Its number from 1; `None` for the only segment of a clip.
    #[serde(skip_serializing_if = "Option::is_none")]
    segment: Option<usize>,
    locale: &'w str,
    state: &'static str,
    source: &'w str,
    /// The source text of the translation, if it is recorded and has changed.
    #[serde(skip_serializing_if = "Option::is_none")]
    translated_from: Option<&'w str>,
    #[serde(skip_serializing_if = "str::is_empty")]
    translation: &'w str,
    words: usize,
    /// The best match of the source text: `new`, `87 %`, `100 %` or `repeated`.
    #[serde(rename = "match")]
    found: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    cost: Option<f64>,
}

/// Returns the selected segments of a locale.
pub(super) fn rows<'w>(
    work: &'w LocaleWork,
    is_meant: impl Fn(Progress) -> bool,
    cost_per_word: Option<f64>,
) -> Vec<OpenRow<'w>> {
    let row = |(open, found): (&'w OpenSegment, SourceMatch)| {
        let words = words(&open.source);
        OpenRow {
            key: &open.key,
            segment: open.number,
            locale: &work.locale,
            state: open.progress().name(),
            source: &open.source,
            translated_from: open.made_from.as_deref(),
            translation: &open.text,
            words,
            found: found.name(),
            cost: cost_per_word.map(|cost| (words as f64 * cost * 100.0).round() / 100.0),
        }
    };
    let open = work.open.iter().zip(work.matches());
    open.filter(|(open, _)| is_meant(open.progress())).map(row).collect()
}
