//! Recordings and their scripts become mouth shapes.
//!
//! A [`Script`] is what is said: words with all their pronunciations, made of [`Phone`]s. A [`Pronouncer`] makes it of
//! a text.
//!
//! What is not here: Lipz files and banks, settings, printing (`lipz`).

#![forbid(unsafe_code)]

mod language;
mod phone;
mod problem;
mod pronounce;
mod script;
mod text;

pub use language::{Language, Reliance};
pub use phone::{ParsePhoneError, Phone};
pub use problem::{Problem, ProblemKind};
pub use pronounce::{Lexicon, Pronouncer, Reading};
pub use script::{Origin, Pronunciation, Script, Word};

/// The example of the README, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
