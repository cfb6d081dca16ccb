//! Conversion of other tools' lip-sync files to and from Lipz files.
//!
//! Each format is one file in `formats/`: it reads bytes into [`Track`]s, which are shapes with exact times in the
//! names of the tool, and writes them. All formats share the rest: a [`Map`] converts names to Lipz codes, [`import`]
//! assigns them to frames and adds the text, and [`export`] does the reverse.
//!
//! ```
//! use lipz_interop::{ImportOptions, formats, import};
//!
//! let format = formats::find("rhubarb-tsv").ok_or("no such format")?;
//! let imported = import(format, b"0.00\tX\n0.25\tD\n0.50\tA\n0.75\tX\n", &ImportOptions::default());
//! let clip = imported.clips.first().ok_or("a clip")?;
//! assert_eq!(clip.document.string("visemes"), Some("------AAAAAAMMMMMM"));
//! # Ok::<(), &str>(())
//! ```
//!
//! This crate does not contain banks, settings, files or printing. Those are parts of `lipz`.

mod encoding;
mod export;
pub mod fallout;
pub mod formats;
mod frames;
mod import;
mod json;
mod map;
mod merge;
mod script;
pub mod second_life;
mod segments;
mod source;
pub mod subtitles;
mod text_element;
pub mod textgrid;
mod time;
mod track;
pub mod weights;
mod xml;

pub use encoding::to_utf8;
pub use encoding_rs::Encoding;
pub use export::{ExportOptions, ExportResult, export};
pub use formats::Format;
pub use frames::LossReason;
pub use import::{DEFAULT_RATE, ImportOptions, ImportResult, ImportedClip, LostShape, import};
pub use map::{Map, built_in as maps, file as map_file, find as find_map};
pub use merge::{MergeOptions, MergedClip, Mouth, merge};
pub use script::{Script, ScriptLine};
pub use segments::Segments;
pub use time::Time;
pub use track::{FaceWeights, Shape, StartedPhone, Text, TimedText, Track, WeightRow};

/// The example of the README, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
