//! Compiler of lipz dialogue banks.
//!
//! Data flows one way: [`discover`] → parse → check → localise → lower → write. Every phase reports
//! what it finds and goes on, so that one run shows all problems of all files; a bank is made only if
//! none of them is an error. [`Compiler::compile`] makes the bank, [`Compiler::pack`] writes it,
//! [`Compiler::pack_cached`] and [`Memory`] look only at what changed since. [`unpack`] goes the other
//! way, [`diff`](mod@diff) compares two banks.
//!
//! A build script packs a folder with [`Build`], which puts the bank and a constant for each clip
//! where the program finds them:
//!
//! ```no_run
//! // build.rs
//! fn main() -> Result<(), lipz_compiler::BuildError> {
//!     lipz_compiler::Build::new("voices").run()
//! }
//! ```
//!
//! [`settings::Settings`] reads what a project decides from its `lipz.toml`. Everything but [`Build`]
//! returns values and [`Report`](diagnostics::Report)s, and leaves it to the caller what to do with them.
//!
//! What is not here: printing (but for [`Build`]) and exit codes (`lipz`); other tools' formats.
// Sizes are checked where they enter (`fit`); casts below are of numbers known to be small.
#![allow(clippy::cast_possible_truncation)]

pub mod babble;
mod bank_with_texts;
mod build;
mod cache;
mod check;
mod clip;
mod compile;
mod convert;
mod coverage;
mod decompile;
mod depend;
pub mod diff;
mod discover;
mod fallback;
mod fix;
mod hashed;
pub mod ids;
mod input;
pub mod key;
mod localise;
mod lower;
mod options;
mod output;
mod pseudo;
mod rewrite;
pub mod settings;
mod source_record;
mod split;
pub mod stats;
mod strings;
mod unpack;

pub use bank_with_texts::BankWithTexts;
pub use build::{Build, BuildError};
pub use cache::Memory;
pub use compile::{CompileError, Compiled, Compiler, Phases};
pub use convert::Converted;
pub use coverage::{Coverage, coverage, shortfalls};
pub use decompile::Documents;
pub use depend::{dependencies, depfile, watched};
pub use discover::{discover, is_pattern};
pub use fix::Fixed;
pub use input::{Content, Input};
pub use lipz_diagnostics as diagnostics;
pub use options::{KnownNames, MinCoverage, Options, TextLimits};
pub use output::replace_file;
pub use rewrite::rewrite_file;
pub use split::SplitBank;
pub use unpack::{Unpacked, unpack};

/// The example of the README, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
