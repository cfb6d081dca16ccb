//! The types shared by all crates of lipz: [`ClipId`], [`VisemeType`], [`Fps`], [`Time`] and the commands of Character
//! Event Syntax. `no_std`, no allocation, no dependencies.
//!
//! `lipz-bank` re-exports the types for games, so that a game depends on one crate. Parsers, importers and other tools
//! use this crate, and need neither the reader nor the binary layout.
//!
//! ```
//! use lipz_types::{ClipId, Fps, Micros, VisemeType};
//! const HELLO: ClipId = ClipId::from_key("act1/hello");
//! assert_eq!(HELLO.to_string().parse(), Ok(HELLO));
//! assert_eq!(Fps::whole(24).frame_at(Micros(500_000)), Some(12));
//! assert_eq!("blair".parse(), Ok(VisemeType::Blair));
//! ```

#![no_std]
#![forbid(unsafe_code)]
// Numbers are only narrowed where they are known to fit.
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

mod command;
mod curve_value;
mod emotion;
mod face_curve;
mod fps;
pub mod hash;
mod id;
mod name;
mod phone;
mod position;
mod stored_fps;
mod strength;
mod time;
mod viseme;
mod weight;

pub use command::Command;
pub use curve_value::CurveValue;
pub use emotion::Emotion;
pub use face_curve::FaceCurve;
pub use fps::Fps;
pub use id::ClipId;
pub use name::UnknownName;
pub use phone::Phone;
pub use position::Position;
pub use stored_fps::StoredFps;
pub use strength::Strength;
pub use time::{AnyTime, Micros, Samples, Seconds, Time};
pub use viseme::{Viseme, VisemeType};
pub use weight::Weight;

/// The first eight bytes of a bank, which identify it. As in PNG, a byte above 127, CR LF, a DOS end-of-file and a lone
/// LF reveal every common damage by text mode.
pub const BANK_MAGIC: [u8; 8] = *b"\x89LPZ\r\n\x1a\n";

/// The example of the README, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
