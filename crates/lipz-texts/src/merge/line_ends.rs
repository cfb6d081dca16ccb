//! Line ends in cells of tables: spreadsheets and version control make CRLF of LF.

use crate::{Entry, Words};
use std::borrow::Cow;
use std::sync::Arc;

/// Line ends of texts that Windows wrote.
const CRLF: &str = "\r\n";

/// The entry with the line ends that the project has: without CR, unless one of its own texts has one.
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
