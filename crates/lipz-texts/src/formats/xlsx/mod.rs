//! XLSX: the table of a CSV as a spreadsheet. OpenDocument spreadsheets can also be read.
//!
//! rust_xlsxwriter writes it. For reading, zip unpacks its parts and quick-xml parses them one tag at a time, so that
//! only texts need memory. calamine, which reads spreadsheets of all kinds, reserves as much memory as a file claims to
//! need, and panics on some damaged files.

mod read;
mod write;

/// The greatest total unpacked size of the parts of any file, in bytes: more than any realistic spreadsheet.
const MAX_UNPACKED_BYTES: u64 = 1 << 29;

pub(crate) use read::read;
pub(crate) use write::{dated_workbook, write};
