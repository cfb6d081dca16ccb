//! Line ends in cells of tables: spreadsheets and version control convert LF to CRLF.

use crate::exchange::entry::{Entry, Words};
use std::borrow::Cow;
use std::sync::Arc;

/// The line end of texts written by Windows.
const CRLF: &str = "\r\n";

/// Returns the entry with the project's line ends: without CR, unless one of the project's texts contains CR.
pub(super) fn of_project<'e>(entry: &'e Entry, texts: &[&[String]]) -> Cow<'e, Entry> {
    let has_crlf = |words: &Words| words.text.contains(CRLF);
    let is_other = entry.is_of_table && (has_crlf(&entry.text) || entry.source.as_deref().is_some_and(has_crlf));
    if !is_other || texts.iter().copied().flatten().any(|text| text.contains('\r')) {
        return Cow::Borrowed(entry);
    }
    let mut entry = entry.clone();
    for words in std::iter::once(&mut entry.text).chain(entry.source.as_mut().map(Arc::make_mut)) {
        words.text = words.text.replace(CRLF, "\n");
    }
    Cow::Owned(entry)
}
