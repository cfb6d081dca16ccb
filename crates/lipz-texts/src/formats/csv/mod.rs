//! CSV: a row per clip or segment, in the columns of several tools.

mod cell;
mod columns;
mod escape;
mod header;
mod read;
mod row;
mod write;

pub use cell::defused;
pub(crate) use columns::{COMMENT, LOCK, TAKE};
pub(crate) use read::{read, separator_of};
pub(crate) use write::{report_misread, write};
#[cfg(feature = "xlsx")]
pub(crate) use {read::CsvTable, row::CsvRow, write::rows};
