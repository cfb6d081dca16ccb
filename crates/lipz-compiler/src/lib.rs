//! Compiler of lipz dialogue banks.
//!
//! Data flows one way: [`discover`] → parse → check → localise → lower → write. Every phase reports its diagnostics and
//! continues, so that one run shows all problems of all files. A bank is made only if there are no errors.
//! [`Compiler::compile`] makes the bank, [`Compiler::pack`] writes it, and [`Compiler::pack_cached`] and [`Memory`]
//! read only changed files. [`unpack`] restores Lipz files, and [`diff`](mod@diff) compares two banks.
//!
//! A build script packs a folder with [`Build`], which writes the bank and a constant for each clip to the folder where
//! the program includes them:
//!
//! ```no_run
//! // build.rs
//! fn main() -> Result<(), lipz_compiler::BuildError> {
//!     lipz_compiler::Build::new("voices").run()
//! }
//! ```
//!
//! [`settings::Settings`] reads the settings of a project from its `lipz.toml`. A function that can fail returns its
//! diagnostics as an error, [`Report`](diagnostics::Report) or [`DiagnosticsError`](diagnostics::DiagnosticsError),
//! which prints them; the value contains the warnings. `…_with_report(s)` continue after errors, for tools that report
//! everything at once.
//!
//! With the feature `human`, a tool prints diagnostics like the command `lipz`:
//!
//! ```
//! # #[cfg(feature = "human")]
//! # {
//! use lipz_compiler::diagnostics::render;
//! use lipz_compiler::{Compiler, Input};
//! let compiled = Compiler::default().compile(&[Input::from_bytes("mayor", r#"{ "fps": 0 }"#)]);
//! let text = render::human(&compiled.reports);
//! assert!(text.contains("error[LZ0301]") && text.contains("--> mayor.lipz:1:10"), "{text}");
//! # }
//! ```
//!
//! # Features
//!
//! * `build` (default): [`Build`] for build scripts, and `ids`: constants for programs.
//! * `cache`: reusing unchanged results, `Compiler::pack_cached` and `Memory`.
//! * `settings`: reading `lipz.toml`.
//! * `shards`: packing on several machines, [`shard`].
//! * `unpack`: restoring a folder of Lipz files from a bank.
//! * `diff`, `stats`: comparing banks, statistics of their contents.
//! * `human`: [`diagnostics::render::human`](crate::diagnostics::render), the diagnostics of a run with the marked source.
//! * `inspect`: the contents of a bank, and a clip as a timeline.
//! * `json`: implements `serde::Serialize` for the results of these and for [`Coverage`], in the format of the command;
//!   `diagnostics::render::to_json` writes it. Also `diagnostics::render::json`, `sarif` and `gitlab`.
//! * `parallel`: uses all cores, also after the files are read.
//! * `full`: all of them.
//!
//! No feature changes a byte of a bank, except for `settings`, with which [`Build`] uses `lipz.toml`.
//!
//! Not included: printing (except in [`Build`]) and exit codes (`lipz`), and formats of other tools.
// Sizes are checked on input (`fit`). The casts below apply to numbers known to be small.
#![allow(clippy::cast_possible_truncation)]

mod bank;
#[cfg(feature = "build")]
mod build;
mod check;
mod clip;
mod edit;
mod files;
mod locales;
mod project;
mod run;
mod sources;
mod util;
#[cfg(any(feature = "diff", feature = "ids", feature = "inspect", feature = "json", feature = "stats"))]
mod views;

pub use bank::{ClipWeights, Coverage, Documents, SplitBank, Stack, VoiceBanks, VoiceCoverage};
#[cfg(feature = "unpack")]
pub use bank::{Unpacked, unpack};
pub use bank::{coverage, dialogue_of, shortfalls, voice_coverage, voice_coverage_of};
#[cfg(feature = "build")]
pub use build::{Build, BuildError};
pub use edit::{ConvertedFile, FixedFile, rewrite_file};
pub use files::{OutputFile, Replace, Replacements, replace_file};
pub use lipz_diagnostics as diagnostics;
pub use project::{
    EmotionCurves, EmotionOptions, FileLevels, GestureKeys, Gestures, KnownNames, LocaleError, MinCoverage, Options,
    ParseWordTimesError, TextLimits, VoiceError, Voices, WordTime, WordTimes,
};
pub use project::{articulation, babble, dependencies, depfile, face, rigs, settings, watched};
#[cfg(feature = "cache")]
pub use run::Memory;
#[cfg(feature = "shards")]
pub use run::shard;
pub use run::{
    CheckResult, CompileError, Compiled, Compiler, DeliveredFiles, Lint, LintResult, Outputs, Phases, StackBelow,
};
pub use sources::{Content, Input, Inputs, discover, discover_with_reports, is_pattern, key, resolved_below};
#[cfg(feature = "diff")]
pub use views::diff;
#[cfg(feature = "ids")]
pub use views::ids;
#[cfg(feature = "inspect")]
pub use views::inspect;
#[cfg(feature = "stats")]
pub use views::stats;

/// The example of the README, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
