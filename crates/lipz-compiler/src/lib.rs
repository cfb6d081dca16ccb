//! Compiler of lipz dialogue banks.
//!
//! Data flows one way: [`discover`] → parse → check → localise → lower → [`replace_file`]. Every
//! phase reports what it finds and goes on, so that one run shows all problems of all files; a bank
//! is made only if none of them is an error. [`unpack`] goes the other way.
//!
//! A build script packs a folder like this:
//!
//! ```no_run
//! use lipz_compiler::{Options, compile, discover, replace_file};
//! use std::path::{Path, PathBuf};
//!
//! let sources = PathBuf::from("voices");
//! println!("cargo::rerun-if-changed={}", sources.display());
//! let (inputs, mut reports) = discover(&[sources], None);
//! let mut compiled = compile(&inputs, &Options::default(), &|_| {});
//! reports.append(&mut compiled.reports);
//! for report in &reports {
//!     for found in &report.diagnostics {
//!         let place = report.source.line_column(found.start());
//!         let (path, line, headline) = (&report.source.path, place.line, &found.headline);
//!         println!("cargo::warning={path}:{line}: {}: {headline} ({})", found.level, found.code);
//!     }
//! }
//! let bank = compiled.bank.expect("findings at error level");
//! let output = Path::new(&std::env::var("OUT_DIR").expect("set by cargo")).join("dialogue.lipzbank");
//! replace_file(&output, &bank).expect("the bank cannot be written");
//! ```
//!
//! What is not here: printing, settings files and exit codes (`lipz-cli`); other tools' formats.
// Sizes are checked where they enter (`fit`); casts below are of numbers known to be small.
#![allow(clippy::cast_possible_truncation)]

mod check;
mod clip;
mod compile;
mod coverage;
mod discover;
mod fallback;
mod input;
pub mod key;
mod localise;
mod lower;
mod options;
mod output;
mod pseudo;
mod raise;
mod report;
mod source_record;
mod split;
mod unpack;

pub use compile::{Compiled, Phases, Progress, check_all, compile};
pub use coverage::{Coverage, coverage};
pub use discover::discover;
pub use input::{Content, Input};
pub use options::{Levels, Options, Registry, TextLimits};
pub use output::replace_file;
pub use raise::Documents;
pub use report::{Report, count};
pub use split::{Split, split};
pub use unpack::{Unpacked, unpack};

/// The example of the README, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;
