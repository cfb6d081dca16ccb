//! Recordings and their scripts become mouth shapes.
//!
//! A [`Script`] is what is said: words with all their pronunciations, made of [`Phone`]s.
//!
//! What is not here: Lipz files and banks, settings, printing (`lipz`).

#![forbid(unsafe_code)]

mod phone;
mod script;

pub use phone::{ParsePhoneError, Phone};
pub use script::{Origin, Pronunciation, Script, Word};

/// The example of the README, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
