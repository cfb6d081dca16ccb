//! Exchange of the texts of Lipz files with translators: PO, XLIFF, CSV, XLSX and JSON files.
//!
//! [`Collect`] makes a [`Unit`] of each clip: its segments with their texts, and information for translators, such as
//! the speaker, the time, the duration and the events. [`write()`] converts them to a file for translation tools,
//! [`read()`] returns the [`Entry`]s of such a file, and [`Merge`] inserts them into the Lipz file. Only the
//! translator's changes are made there, and problems become diagnostics with a position in the translator's file.
//!
//! An exchange file contains the [`Mark`] of each translation at the time of export. Therefore an old file does not
//! undo newer work: unchanged texts in it keep the project's version.
//!
//! A [`RecordingScript`] has the lines that a studio records. With [`ReadOptions::takes`], [`read()`] returns the
//! [`ChosenTake`]s of the table that the studio sends back.
//!
//! # Features
//!
//! * `xlsx`: spreadsheets, which require crates for archives.
//!
//! This crate does not handle files and folders, settings, printing (parts of `lipz`) or banks.

mod exchange;
mod formats;
mod lint;
mod merge;
mod plural;
mod progress;
mod record;
mod script;

pub use exchange::{
    ChosenTake, ClipSources, ClipTexts, Collect, Division, Entry, Exchange, IncomingFile, Mark, ReadOptions, Segment,
    Shape, SourceTexts, State, Translation, Unit, Words, WriteOptions, difference, texts_of, words,
};
pub use formats::csv::defused;
pub use formats::{Format, WriteResult, WrittenFile, read, write};
pub use lint::{Font, FontError, FontLimit, LinePixels, Terms, TextLints, check_glyphs, has_translations};
pub use merge::{
    ConfirmedTranslations, Counts, Merge, MergedFile, TextTranslations, TranslatorComments, follow_renamed_clips,
    resolve_keys, unknown_keys,
};
pub use progress::{
    Amount, LocaleWork, OpenSegment, Progress, SourceMatch, Work, cost_of, csv_table, html, html_page, page,
};
pub use record::{Standing, TextRecord};
pub use script::{CharacterCues, RecordingScript, ScriptLine};

/// The example of the README, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
