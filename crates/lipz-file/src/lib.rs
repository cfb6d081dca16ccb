//! Lipz files: the JSON format for spoken dialogue, as a library.
//!
//! A Lipz file contains one voice clip: one viseme code per frame, subtitles per locale, and events per segment (Lipz
//! File Format 1.0 by Erik Hermansen). This crate parses such a file into a [`Document`] that stores the position of
//! each character, and writes it again. It also implements the format's rules for [texts](mod@text),
//! [locales](mod@locale) and [frame rates](mod@rate). Problems of a file are a list of
//! [`Diagnostic`](lipz_diagnostics::Diagnostic)s.
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
//! Other crates check elements against each other and apply project-wide rules (`lipz-compiler`), read the binary bank
//! (`lipz-bank`), and print (`lipz`).

pub mod curve;
pub mod digits;
mod document;
pub mod emotion;
pub mod event;
#[cfg(feature = "format")]
pub mod format;
mod literal_walk;
pub mod locale;
#[cfg(feature = "format")]
pub mod merge;
mod parse;
pub mod phones;
pub mod placeholder;
pub mod rate;
pub mod schema;
pub mod table;
pub mod text;
mod write;
mod xml_bounds;

pub use document::{Document, Element, JsonString, RawJson, Value};
pub use parse::{
    Fragment, MAX_FILE_BYTES, ParsedFile, decode, decode_marked, parse, too_large, without_byte_order_mark,
};
pub use write::{literal, write};
pub use xml_bounds::{MOST_XML_ATTRIBUTES, costly_xml_tag};

/// The example of the README, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
