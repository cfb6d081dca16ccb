//! Lip-sync files of other tools, to and from Lipz files.
//!
//! Each format is one file in `formats/`: it reads bytes into [`Track`]s, shapes with exact times in the
//! names of the tool, and writes them. What is common to all is done once: a [`Map`] turns names into Lipz
//! codes, [`import`] lays them out in frames and joins the text, and [`export`] goes the other way.
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
//! What is not here: banks and their layout, settings, files and printing (`lipz`).

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
pub mod textgrid;
mod time;
mod track;
mod xml;

pub use encoding::to_utf8;
pub use encoding_rs::Encoding;
pub use export::{ExportOptions, Exported, export};
pub use formats::Format;
pub use frames::LossReason;
pub use import::{Clip, DEFAULT_RATE, ImportOptions, Imported, LostShape, import};
pub use map::{Map, built_in as maps, file as map_file, find as find_map};
pub use merge::{MergeOptions, Merged, Mouth, merge};
pub use script::Script;
pub use segments::Segments;
pub use time::Time;
pub use track::{Shape, Text, Timed, Track};

/// The example of the README, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
