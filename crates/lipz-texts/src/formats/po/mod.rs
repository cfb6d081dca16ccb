//! gettext PO: an entry per clip or segment, with information for translators in its comments.

mod plural;
mod read;
mod string;
mod write;

pub(crate) use read::read;
pub(crate) use write::write;

/// The prefix of a translation's mark in the comments of an entry.
const EXPORTED: &str = "as exported: ";

/// The prefix of the marks of the source texts of plural forms, of which an entry contains only two.
const SOURCES_EXPORTED: &str = "sources as exported: ";

/// The prefix of the mark of translators' comments.
const COMMENTS_EXPORTED: &str = "comments as exported: ";
