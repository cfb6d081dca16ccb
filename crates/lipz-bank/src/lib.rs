//! Reader of lipz dialogue banks: `no_std`, no allocation, no `unsafe`.
//!
//! A *bank* is one packed file that holds the mouth shapes, subtitles and events of many spoken
//! lines. It is used in place: from a memory map, from ROM, from any `&[u8]`. The data flows one
//! way, bytes → [`Bank`] → [`Clip`] → [`Segment`].
//!
//! Four types are the ones to read first:
//!
//! * [`Bank`] opens the bytes, and finds clips, locales and names.
//! * [`Clip`] is one spoken line: mouth shapes and segments by time.
//! * [`Segment`] is a stretch of it: subtitles and events.
//! * [`Cursor`] follows the sound through a clip and fires each event once. A game keeps it from picture to picture,
//!   beside its bank.
//!
//! ```
//! use lipz_bank::{Bank, ClipId, Micros};
//!
//! // Ids are computed while compiling; a key is the path of a Lipz file without extension.
//! const GOOD_EVENING: ClipId = ClipId::from_key("act1/mara-good-evening");
//!
//! # fn main() -> Result<(), lipz_bank::Error> {
//! # let bytes: &[u8] = include_bytes!("../examples/act1.lipzbank");
//! let bank = Bank::open(bytes)?.verify()?;
//! let now = Micros(1_500_000);
//! if let (Some(clip), Some(german)) = (bank.clip(GOOD_EVENING), bank.locale("de-de")) {
//!     let mouth = clip.viseme_at(now); // rest outside the clip, never an error
//!     let text = clip.segment_at(now).and_then(|segment| segment.text(german));
//!     println!("{mouth} {}", text.map_or("", |text| text.as_str()));
//! }
//! # Ok(())
//! # }
//! ```
//!
//! # Features
//!
//! `std`, on by default, implements `std::error::Error` for [`Error`]. The reader itself never needs it: for
//! firmware, depend on `lipz-bank` with `default-features = false`.
//!
//! # Trust
//!
//! [`Bank::open`] looks at the header and the directory only. After it, no call panics, reads out
//! of bounds or loops without bound, whatever the bytes are: on damage a query returns `None` or
//! rest. [`Bank::verify`] checks every byte and every reference; after it has passed, no query fails for which the
//! compiler stored data, and texts are returned without being checked again.
//!
//! A [`Locale`] or an [`EventName`] of another bank leads to nothing. That is a mistake of the program, so debug
//! builds stop there with an assertion.
//!
//! The checksum finds damage. It does not prove who wrote a file: sign banks that come from
//! strangers, as any other code or asset.

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

mod babble;
mod bank;
mod bank_set;
mod clip;
mod curve;
mod emotions;
mod error;
mod event;
mod face;
mod file;
mod layers;
mod locale;
mod openness;
mod origin;
mod places;
mod playback;
mod pool;
mod recording;
mod segment;
mod set_index;
mod text;
mod text_bank;
mod verify;
mod voice;
mod who;

pub use babble::{Babble, Babbles, Power, VoiceLevel, Weights};
pub use bank::Bank;
pub use bank_set::{BankSet, BankSetError, SetLocale, SetName, SetVoice};
pub use clip::{Clip, Clips};
pub use curve::{Curve, CurveCursor, CurveKey, Curves};
pub use emotions::Emotions;
pub use error::{Error, ErrorKind};
pub use event::{Event, EventName, Events};
pub use face::{Face, FaceProfile, FaceProfiles, LookAt};
pub use layers::{Layer, LayeredClip, LayeredClips, LayeredLocale, LayeredName, Layers, LayersError};
pub use layers::{LayeredVoice, LayeredVoicedClip, Stacked, VoiceTags, original_of, played_in, voice_tags};
pub use locale::{Locale, Locales};
pub use places::Places;
pub use playback::{CharacterState, Characters, ConsonantHold, Cursor, DueSegments, Lead};
pub use recording::Recording;
pub use segment::{Segment, Segments};
pub use set_index::{SetBank, SetIndex};
pub use text::Text;
pub use text_bank::TextBank;
pub use voice::{Spoken, Voice, VoicedClip, Voices};
pub use who::Who;

pub use lipz_types::{
    ClipId, Command, CurveValue, Emotion, FaceCurve, Fps, Micros, Samples, Seconds, Time, Viseme, VisemeType, Weight,
};

/// The example of the README, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
