//! Recordings and their scripts become mouth shapes.
//!
//! A [`Script`] is what is said: words with all their pronunciations, made of [`Phone`]s. A [`Pronouncer`] makes it of
//! a text, and an [`Aligner`] finds when each word and phone of it is said in a [`Sound`].
//! [`render`] makes a mouth of that, a viseme for every frame; [`rms`] makes one of the loudness alone.
//!
//! Results are the same on every machine, to the last bit.
//!
//! What is not here: Lipz files and banks, settings, printing (`lipz`).

#![forbid(unsafe_code)]

mod align;
mod features;
mod label;
mod language;
mod model;
mod neural;
mod phone;
mod problem;
mod pronounce;
mod render;
mod script;
mod sound;
mod text;
mod train;

pub use align::{AlignOptions, AlignedPhone, AlignedWord, Aligner, Alignment, Mismatch, MismatchKind};
pub use label::phones_of_label;
pub use language::{Language, Reliance};
pub use model::Model;
pub use neural::{Heard, Recogniser, RecogniserError};
pub use phone::{ParsePhoneError, Phone};
pub use problem::{Problem, ProblemKind};
pub use pronounce::{Lexicon, Pronouncer, Reading};
pub use render::{Mouth, RenderRules, RmsRules, render, rms};
pub use script::{Origin, Pronunciation, Script, Word};
pub use sound::{Clipping, Damage, Sound, SoundError};
pub use train::{ModelError, Observations, TrainedModel, Training};

/// The example of the README, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
