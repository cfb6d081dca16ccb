//! gettext PO: an entry for each clip or segment, with what translators should know in its comments.

mod read;
mod string;
mod write;

pub(crate) use read::read;
pub(crate) use write::write;

/// What stands before the mark of a translation in the comments of an entry.
const EXPORTED: &str = "as exported: ";
