//! Test helpers for all crates of lipz and for firmware.
//!
//! `answers` writes the answers of a bank. Without features, it is the only module, because firmware has no `std`. With
//! `std`, there are golden banks, forged ones and every query of them (`golden`, `forge`, `exercise`), and fonts; with
//! `tools`, guarantees of the compiler's tools and for any bytes (`tools`, `fuzz`).
// A helper fails by panicking, which tests and fuzzers detect.
#![cfg_attr(not(feature = "std"), no_std)]
#![allow(missing_docs, reason = "the helpers of tests say in their names what they do")]
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::cast_possible_truncation)]
#![allow(clippy::missing_panics_doc, reason = "all of them do")]

pub mod answers;
#[cfg(feature = "std")]
pub mod dialogues;
#[cfg(feature = "tools")]
pub mod documents;
#[cfg(feature = "std")]
pub mod exercise;
#[cfg(feature = "std")]
pub mod font;
#[cfg(feature = "std")]
pub mod forge;
#[cfg(feature = "tools")]
pub mod fuzz;
#[cfg(feature = "std")]
pub mod golden;
#[cfg(feature = "tools")]
pub mod layouts;
#[cfg(feature = "std")]
mod said;
#[cfg(feature = "std")]
pub mod stacked;
#[cfg(feature = "std")]
pub mod texts;
#[cfg(feature = "tools")]
pub mod tools;

/// The programs on the pages of `docs/` compile.
#[cfg(doctest)]
#[doc = include_str!("../../../docs/guides/playback.md")]
#[doc = include_str!("../../../docs/guides/faces.md")]
#[doc = include_str!("../../../docs/guides/dialogue-files.md")]
#[doc = include_str!("../../../docs/guides/patches.md")]
#[doc = include_str!("../../../docs/guides/localisation.md")]
#[doc = include_str!("../../../docs/guides/fallout-and-second-life.md")]
struct Pages;

/// The programs of the page on lip sync compile.
#[cfg(all(doctest, feature = "tools"))]
#[doc = include_str!("../../../docs/guides/lip-sync.md")]
struct LipSync;

/// The build scripts compile. The program on the page is the one in `examples/dialogue-player/examples`.
#[cfg(all(doctest, feature = "tools"))]
#[doc = include_str!("../../../docs/guides/build-scripts.md")]
struct BuildScripts;

/// The example of the project's README, run as a test.
#[cfg(all(doctest, feature = "tools"))]
#[doc = include_str!("../../../README.md")]
struct Readme;
