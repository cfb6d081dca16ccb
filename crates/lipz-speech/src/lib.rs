//! Recordings and their scripts become mouth shapes.
//!
//! [`LipSync`] does it in one call:
//!
//! ```no_run
//! use lipz_speech::{Language, LipSync};
//! let line = LipSync::new(Language::ENGLISH).file("mara-hello.wav", "Good evening, Mara.")?;
//! println!("{}", line.mouth.frames); // a viseme for each frame, 24 per second
//! # Ok::<(), lipz_speech::SoundError>(())
//! ```
//!
//! # Step by step
//!
//! [`Sound::read`] decodes a recording. A [`Pronouncer`] makes a [`Script`] of a text: its words with all their pronunciations,
//! which consist of [`Phone`]s. An [`Aligner`] finds when each word and phone of the script is said in the sound. [`render`]
//! makes a mouth of this [`Alignment`], a viseme for every frame; [`rms`] makes one of the loudness alone. Arguments come in
//! this order: sound, script or alignment, frames per second, viseme type, rules.
//!
//! Results are the same on every machine, to the last bit.
//!
//! What is not here: Lipz files and banks, settings, printing (`lipz`).

#![forbid(unsafe_code)]

mod align;
mod features;
mod label;
mod language;
mod lip_sync;
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
pub use lip_sync::{LipSync, SyncedLine};
pub use lipz_types::{Fps, VisemeType};
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
