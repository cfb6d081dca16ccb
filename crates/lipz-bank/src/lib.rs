//! Reader of lipz dialogue banks: `no_std`, no allocation, no `unsafe`.
//!
//! A *bank* is one packed file with the visemes, subtitles and events of many spoken lines. It is used in place: from a
//! memory map, from ROM, from any `&[u8]`. A *dialogue* is a bank or a set of banks, with any patches and text banks.
//! Data flows one way, files → [`Dialogue`] → [`Clip`] → [`Segment`].
//!
//! Start with four types:
//!
//! * [`Dialogue`] opens the files, and finds clips, locales and names. [`Bank`] does the same for one file.
//! * [`Clip`] is one spoken line: visemes and segments by time.
//! * [`Segment`] is a part of a clip, with subtitles and events.
//! * [`Cursor`] follows the audio through a clip and fires each event once. A game keeps it between rendered frames,
//!   next to its dialogue.
//!
//! ```
//! use lipz_bank::files::DialogueFile;
//! use lipz_bank::{ClipId, Dialogue, Micros};
//!
//! // Ids are computed at compile time; a key is the path of a Lipz file without extension.
//! const GOOD_EVENING: ClipId = ClipId::from_key("act1/mara-good-evening");
//!
//! # fn main() -> Result<(), lipz_bank::files::DialogueError> {
//! # let bank: &[u8] = include_bytes!("../examples/act1.lipzbank");
//! let mut files = [DialogueFile::ABSENT; 8]; // room for the bank, patches and text banks
//! let dialogue = Dialogue::open(&mut files, [bank])?;
//! let now = Micros(1_500_000);
//! if let (Some(clip), Some(german)) = (dialogue.clip(GOOD_EVENING), dialogue.locale("de-de")) {
//!     let mouth = clip.viseme_at(now); // rest outside the clip, never an error
//!     let text = clip.segment_at(now).and_then(|segment| segment.text(german));
//!     println!("{mouth} {}", text.map_or("", |text| text.as_str()));
//! }
//! # Ok(())
//! # }
//! ```
//!
//! [design.md](https://github.com/lipz/lipz/blob/main/docs/inside/design.md) explains this API.
//!
//! # Features
//!
//! `std`, on by default, implements `std::error::Error` for [`Error`]. The reader itself never needs it: for firmware,
//! depend on `lipz-bank` with `default-features = false`.
//!
//! # Trust
//!
//! [`Dialogue::open`] and [`Bank::verify`] check every byte and every reference. Afterwards, no query fails for which
//! the compiler stored data, and texts are returned without being checked again.
//!
//! [`Dialogue::open_unverified`], [`Dialogue::open_bank`] and [`Bank::open`] check headers and directories only. Even
//! then, no call panics, reads out of bounds or loops forever, whatever the bytes are. For damaged data, a query
//! returns `None` or rest.
//!
//! A [`Locale`] from a different dialogue, or a different version of it, leads to no text. A [`Voice`] leads to the
//! clip itself.
//!
//! The checksum detects damage. It does not authenticate the author: sign files from untrusted sources, like any other
//! code or asset.

#![no_std]
#![forbid(unsafe_code)]
// Lengths and offsets fit 32 bits: `open` checks the file length, slices do the rest.
#![allow(clippy::cast_possible_truncation)]
#![cfg_attr(
    not(test),
    deny(
        clippy::indexing_slicing,
        clippy::arithmetic_side_effects,
        clippy::unwrap_used,
        clippy::expect_used,
        clippy::panic
    )
)]

#[cfg(any(feature = "std", test))]
extern crate std;

mod bank;
mod clip;
mod dialogue;
mod error;
mod event;
mod file;
mod locale;
mod openness;
mod origin;
mod pool;
mod recording;
mod segment;
mod set_index;
mod text;
mod verify;
mod voice;

pub mod articulation;
pub mod babble;
pub mod curve;
pub mod face;
pub mod files;
pub mod playback;

pub use bank::Bank;
pub use clip::Clip;
pub use dialogue::Dialogue;
pub use error::{Error, ErrorKind};
pub use event::{Event, EventName};
pub use locale::Locale;
pub use playback::Cursor;
pub use recording::Recording;
pub use segment::Segment;
pub use text::Text;
pub use voice::{Voice, VoiceSource, VoicedClip};

pub use lipz_types::{AnyTime, ClipId, Command, Fps, Micros, Samples, Seconds, Strength, Time, Viseme, VisemeType};

/// The example of the README, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
