//! Compiler of lipz dialogue banks.
//!
//! Data flows one way: [`discover`] → parse → check → localise → lower → write. Every phase reports
//! what it finds and goes on, so that one run shows all problems of all files; a bank is made only if
//! none of them is an error. [`compile`] gives the bank, [`pack`] writes it. [`unpack`] goes the other
//! way.
//!
//! A build script packs a folder like this:
//!
//! ```no_run
//! use lipz_compiler::{Options, discover, pack};
//! use std::path::{Path, PathBuf};
//!
//! let sources = PathBuf::from("voices");
//! println!("cargo::rerun-if-changed={}", sources.display());
//! let (inputs, mut reports) = discover(&[sources], None);
//! let output = Path::new(&std::env::var("OUT_DIR").expect("set by cargo")).join("dialogue.lipzbank");
//! let mut compiled = pack(&inputs, &Options::default(), &output, &|_| {});
//! reports.append(&mut compiled.reports);
//! for report in &reports {
//!     for found in &report.diagnostics {
//!         let place = report.source.line_column(found.start());
//!         let (path, line, headline) = (&report.source.path, place.line, &found.headline);
//!         println!("cargo::warning={path}:{line}: {}: {headline} ({})", found.level, found.code);
//!     }
//! }
//! compiled.bank.expect("findings at error level");
//! ```
//!
//! What is not here: printing, settings files and exit codes (`lipz-cli`); other tools' formats.
// Sizes are checked where they enter (`fit`); casts below are of numbers known to be small.
#![allow(clippy::cast_possible_truncation)]

mod check;
mod clip;
mod compile;
mod discover;
mod hashed;
mod input;
pub mod key;
mod localise;
mod lower;
mod options;
mod output;
mod raise;
mod report;
mod source_record;
mod strings;
mod unpack;

pub use compile::{Compiled, Phases, Progress, check_all, compile, pack};
pub use discover::discover;
pub use input::{Content, Input};
pub use options::{Levels, Options, Registry, TextLimits};
pub use output::replace_file;
pub use raise::Documents;
pub use report::{Report, count};
pub use unpack::{Unpacked, unpack};

/// The example of the README, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;
