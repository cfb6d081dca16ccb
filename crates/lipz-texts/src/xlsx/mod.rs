//! XLSX: the table of a CSV as a spreadsheet.
//!
//! rust_xlsxwriter writes it. To read it, zip unpacks its parts and quick-xml takes them apart, a tag at a time, so that
//! memory is needed for texts only. calamine, which reads spreadsheets of all kinds, reserves as much memory as a file
//! claims to need, and panics on some that are damaged.

mod read;
mod write;

/// What the parts of a file may have unpacked, in bytes, all together, however long it is: more than any spreadsheet
/// that people work with.
const MAX_UNPACKED_BYTES: u64 = 1 << 29;

pub(crate) use read::read;
pub(crate) use write::write;
