//! The texts of Lipz files for translators: PO, XLIFF, CSV, XLSX and JSON files, there and back.
//!
//! [`Collect`] makes a [`Unit`] of each clip: its segments with their texts, and what helps to translate them: who
//! speaks, when, for how long, with which events. [`write()`] makes a file of them that tools for translators open,
//! [`read()`] finds the [`Entry`]s of such a file, and [`Merge`] brings them into the Lipz file: only what a translator
//! changed changes there, and what does not fit is a diagnostic at its place in the translator's file.
//!
//! A file of exchange says what each translation was when it was exported, by its [`Mark`]. So an old file does not undo
//! newer work: a text that nobody changed in it stays as the project has it.
//!
//! # Features
//!
//! * `xlsx`: spreadsheets, which need crates that pack and unpack archives.
//!
//! What is not here: files and folders, settings, printing (`lipz`), banks.

mod changes;
mod collect;
mod csv;
mod decode;
mod entry;
mod format;
mod json;
mod lint;
mod mark;
mod merge;
mod model;
mod placeholder;
mod po;
mod record;
mod tag;
mod words;
mod work;
mod xliff;
#[cfg(feature = "xlsx")]
mod xlsx;

pub use collect::{Collect, texts_of};
pub use csv::{Shape, defused};
pub use entry::{Entry, Incoming, ReadOptions, Words};
pub use format::{Format, WriteOptions, Written, WrittenFile, read, write};
pub use lint::{TextLints, has_translations};
pub use mark::Mark;
pub use merge::{Confirmed, Counts, Merge, Merged, unknown_keys};
pub use model::{Division, Exchange, Segment, State, Translation, Unit};
pub use record::{Standing, TextRecord, Texts};
pub use words::words;
pub use work::{Amount, LocaleWork, OpenSegment, Progress, Work, cost_of, csv_table, html, html_page, page};

/// The example of the README, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
