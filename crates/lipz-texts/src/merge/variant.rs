//! Entries of variants, in the form of the project: blank where the text of the locale is shown.

use crate::exchange::clip_texts::trimmed;
use crate::exchange::model::joined;
use crate::exchange::{Entry, SourceTexts};
use lipz_file::text::trim;
use std::borrow::Cow;

/// Gives an entry of a variant the source text of the project, if the file has the same in another form. Leaves segments
/// blank that do not vary in the source, and are as in one of the `known` texts of the locale.
pub(super) fn as_in_project(entry: &mut Cow<'_, Entry>, from: &SourceTexts<'_>, known: [Option<&[String]>; 2]) {
    let segment = entry.segment.map(|number| number.saturating_sub(1));
    if let Some(source) = &entry.source {
        let then = match segment {
            Some(_) => trim(&source.text).to_owned(),
            None => joined(&trimmed(&source.text)),
        };
        if let Some(current) = from.current(segment, &then).filter(|current| *current != then) {
            let mut source = (**source).clone();
            source.text = current;
            entry.to_mut().source = Some(source.into());
        }
    }
    let texts = trimmed(&entry.text.text);
    if segment.is_some() || texts.len() != from.texts.len() {
        return;
    }
    let is_shown = |at: usize, text: &String| known.iter().flatten().any(|known| known.get(at) == Some(text));
    let blank = |(at, text): (usize, &String)| {
        let varies = from.texts.get(at).is_some_and(|source| !source.is_empty());
        if !varies && is_shown(at, text) { String::new() } else { text.clone() }
    };
    let blank: Vec<String> = texts.iter().enumerate().map(blank).collect();
    if blank != texts {
        entry.to_mut().text.text = joined(&blank);
    }
}
