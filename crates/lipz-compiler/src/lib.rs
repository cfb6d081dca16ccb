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
//! [`settings::Settings`] reads what a project decides from its `lipz.toml`. A function that can fail returns its diagnostics
//! as an error, [`Report`](diagnostics::Report) or [`DiagnosticsError`](diagnostics::DiagnosticsError), which prints them; warnings
//! are in the value. `…_with_report(s)` go on after errors, for tools that report everything at once.
//!
//! A tool prints diagnostics as the command `lipz` does, with the feature `human`:
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
//! * `cache`: recalling what did not change, `Compiler::pack_cached` and `Memory`.
//! * `settings`: reading `lipz.toml`.
//! * `shards`: packing on several machines, [`shard`].
//! * `unpack`: from a bank to a folder of Lipz files.
//! * `diff`, `stats`: comparing banks, counting what is in them.
//! * `human`: [`diagnostics::render::human`](crate::diagnostics::render), the diagnostics of a run with the marked source.
//! * `inspect`: what is in a bank, and a clip as a timeline.
//! * `json`: what these return, and [`Coverage`], is `serde::Serialize`, in the form that the command prints;
//!   `diagnostics::render::to_json` writes it. Also `diagnostics::render::json`, `sarif` and `gitlab`.
//! * `parallel`: all cores, also after the files are read.
//! * `full`: all of them.
//!
//! No feature changes a byte of a bank, but for `settings`, with which [`Build`] goes by `lipz.toml`.
//!
//! What is not here: printing (but for [`Build`]) and exit codes (`lipz`); other tools' formats.
// Sizes are checked where they enter (`fit`); casts below are of numbers known to be small.
#![allow(clippy::cast_possible_truncation)]

pub mod babble;
#[cfg(feature = "build")]
mod build;
#[cfg(feature = "cache")]
mod cache;
mod check;
mod clip;
mod compile;
mod convert;
mod coverage;
mod decompile;
mod depend;
mod dialogue;
#[cfg(feature = "diff")]
pub mod diff;
mod discover;
mod dubs;
pub mod face;
mod fallback;
mod fix;
mod hashed;
#[cfg(feature = "ids")]
pub mod ids;
mod input;
#[cfg(feature = "inspect")]
pub mod inspect;
#[cfg(feature = "json")]
mod json;
pub mod key;
#[cfg(unix)]
mod last_folder;
mod layers;
mod list;
mod localise;
mod lock;
mod lower;
#[cfg(not(feature = "cache"))]
mod no_cache;
mod options;
mod output;
mod outputs;
mod parallel;
mod pipe;
mod pseudo;
mod replacements;
mod rewrite;
mod same;
pub mod settings;
#[cfg(feature = "shards")]
pub mod shard;
mod source_index;
mod source_record;
mod split;
#[cfg(feature = "stats")]
pub mod stats;
mod strings;
mod temporary;
#[cfg(feature = "unpack")]
mod unpack;
mod voices;
mod walk;
mod word_times;

#[cfg(feature = "build")]
pub use build::{Build, BuildError};
#[cfg(feature = "cache")]
pub use cache::Memory;
pub use compile::{Checked, CompileError, Compiled, Compiler, Lint, Linted, Phases};
pub use convert::Converted;
pub use coverage::{Coverage, coverage, shortfalls};
pub use decompile::Documents;
pub use depend::{dependencies, depfile, watched};
pub use discover::{discover, discover_with_reports, is_pattern};
pub use dubs::{VoiceCoverage, voice_coverage, voice_coverage_of};
pub use fix::Fixed;
pub use input::{Content, Input, Inputs};
pub use layers::{Over, Stack, VoiceBanks, dialogue_of};
pub use lipz_diagnostics as diagnostics;
pub use options::{
    EmotionCurves, EmotionOptions, FileLevels, GestureKeys, Gestures, KnownNames, LocaleError, MinCoverage, Options,
    TextLimits,
};
pub use output::replace_file;
pub use outputs::{Delivered, OutputFile, Outputs, Replace};
pub use replacements::Replacements;
pub use rewrite::rewrite_file;
pub use split::SplitBank;
#[cfg(feature = "unpack")]
pub use unpack::{Unpacked, unpack};
pub use voices::{VoiceError, Voices};
pub use word_times::{ParseWordTimesError, WordTime, WordTimes};

#[cfg(not(feature = "cache"))]
use no_cache as cache;

/// The example of the README, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
