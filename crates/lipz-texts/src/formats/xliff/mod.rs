//! XLIFF: version 2.1 (OASIS 2018), which has a unit per clip and a segment for each of its segments, and 1.2 for tools
//! without support for later versions.

mod ids;
mod read;
mod read1;
mod read2;
mod write1;
mod write2;
mod xml;

pub(crate) use read::read;
pub(crate) use write1::write as write_1_2;
pub(crate) use write2::write as write_2_1;

/// The category of notes with marks, and the prefix of a mark in a note of version 1.2.
const EXPORTED: &str = "as exported";

/// The same for the mark of translators' comments.
const COMMENTS_EXPORTED: &str = "comments as exported";

/// The type of a placeholder for a character that XML does not allow.
const CHARACTER: &str = "x-lipz-character";
