//! Compiler of lipz dialogue banks.
//!
//! Data flows one way: [`discover`] → parse → check → localise → lower → [`replace_file`]. Every
//! phase reports what it finds and goes on, so that one run shows all problems of all files; a bank
//! is made only if none of them is an error. [`unpack`] goes the other way.
//!
//! What is not here: printing, settings files and exit codes (`lipz-cli`); other tools' formats.
// Sizes are checked where they enter (`fit`); casts below are of numbers known to be small.
#![allow(clippy::cast_possible_truncation)]

mod check;
mod clip;
mod compile;
mod discover;
mod input;
pub mod key;
mod localise;
mod lower;
mod options;
mod output;
mod raise;
mod report;
mod source_record;
mod unpack;

pub use compile::{Compiled, Phases, Progress, check_all, compile};
pub use discover::discover;
pub use input::{Content, Input};
pub use options::Options;
pub use output::replace_file;
pub use raise::Documents;
pub use report::{Report, count};
pub use unpack::{Unpacked, unpack};

/// The example of the README, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;
