//! Bevy plugin for lipz dialogue banks: lip sync, subtitles and events.
//!
//! Add [`LipzPlugin`], and spawn a [`LipzPlayer`] with a bank and the key of a clip. The player triggers a
//! [`LipzSubtitle`] for each subtitle and a [`LipzEvent`] for each event, and sets its [`LipzMouth`]. A [`LipzFace`]
//! moves the morph targets of a model, and a [`LipzSprite`] shows the pictures of a sprite sheet.
//!
//! The [README](https://github.com/lipz/lipz/tree/main/packages/bevy_lipz) has an example and a table of versions.

#![forbid(unsafe_code)]

mod bank;
mod clock;
mod error;
mod events;
#[cfg(feature = "face")]
mod face;
#[cfg(any(feature = "face", feature = "sprite"))]
mod hierarchy;
mod line;
mod mouth;
mod playback;
mod player;
mod plugin;
#[cfg(feature = "sprite")]
mod sprite;

pub use bank::{BankLoadError, BankLoader, LipzBank};
pub use clock::LipzClock;
pub use error::LipzError;
pub use events::{LipzEvent, LipzFailed, LipzFinished, LipzSegment, LipzSubtitle};
#[cfg(feature = "face")]
pub use face::{LipzFace, LipzShapes};
pub use lipz_bank;
pub use mouth::LipzMouth;
pub use player::LipzPlayer;
#[doc(hidden)]
pub use player::PlayerState;
pub use plugin::{LipzPlugin, LipzSystems};
#[cfg(feature = "sprite")]
pub use sprite::LipzSprite;

/// Everything that most games need: `use bevy_lipz::prelude::*`.
pub mod prelude {
    #[cfg(feature = "sprite")]
    pub use crate::LipzSprite;
    pub use crate::{LipzBank, LipzClock, LipzError, LipzEvent, LipzFailed, LipzFinished, LipzMouth, LipzPlayer};
    #[cfg(feature = "face")]
    pub use crate::{LipzFace, LipzShapes};
    pub use crate::{LipzPlugin, LipzSegment, LipzSubtitle, LipzSystems};
}

/// The example of the README, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
