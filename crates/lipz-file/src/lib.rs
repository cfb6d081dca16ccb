//! Lipz files: the JSON format for spoken dialogue, as a library.
//!
//! A Lipz file holds one voice clip: one mouth-shape code per frame, subtitles per locale, events
//! per segment (Lipz File Format 1.0 by Erik Hermansen). This crate reads such a file into a
//! [`Document`] that knows where each of its characters stands, writes it again, and carries the
//! rules that the format states about [texts](mod@text), [locales](mod@locale) and
//! [frame rates](mod@rate). What is wrong with a file is a list of [`Diagnostic`](lipz_diagnostics::Diagnostic)s.
//!
//! ```
//! let file = br#"{ "fps": 24, "visemes": "SMA-|EOO-", "text_en-us": "Hello, |Amy." }"#;
//! let parsed = lipz_file::parse(file);
//! assert!(parsed.diagnostics.is_empty());
//! let document = parsed.document.ok_or("a valid file")?;
//! assert_eq!(document.string("visemes"), Some("SMA-|EOO-"));
//! assert_eq!(lipz_file::text::display(" {whispering} Amy. ").text, "Amy.");
//! # Ok::<(), &str>(())
//! ```
//!
//! What is not here: checks of one element against another and project-wide rules (crate
//! `lipz-compiler`), the binary bank (`lipz-bank`), printing (`lipz`).

pub mod curve;
pub mod digits;
mod document;
pub mod emotion;
pub mod event;
#[cfg(feature = "format")]
pub mod format;
pub mod locale;
mod parse;
pub mod rate;
pub mod schema;
mod spelled;
pub mod text;
mod write;

pub use document::{Document, Element, JsonString, Raw, Value};
pub use parse::{Fragment, MAX_FILE_BYTES, Parsed, decode, decode_marked, parse, too_large, without_byte_order_mark};
pub use write::{literal, write};

/// The example of the README, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
