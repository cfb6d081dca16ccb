//! Lip sync: makes visemes from recordings and their transcripts.
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
//! [`Sound::read`] decodes a recording. A [`Pronouncer`] turns a text into a [`Script`]: its words with all their
//! pronunciations, which consist of [`Phone`]s. An [`Aligner`] finds the time of each word and phone of the script in
//! the audio. [`render`] turns this [`Alignment`] into a viseme for every frame, and [`rms`] derives the visemes from
//! the loudness alone. Arguments come in this order: audio, script or alignment, frames per second, viseme type, rules.
//!
//! Results are identical on every machine, to the last bit.
//!
//! This crate does not read Lipz files, banks or settings, and prints nothing. Those are parts of `lipz`.

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
pub use neural::{RecognisedWords, Recogniser, RecogniserError};
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
