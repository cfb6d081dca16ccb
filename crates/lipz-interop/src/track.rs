//! The data that other tools store about a recording, before it becomes a Lipz file: shapes with times.

use crate::Time;
use crate::textgrid::Tier;
use lipz_diagnostics::Span;
use lipz_file::Element;
use lipz_file::rate::Rate;

/// The mouth shapes of one speaker in one recording, as stored in a file of another tool.
///
/// Times are exact, and shapes have the names that the tool uses. A [`Map`](crate::Map) converts the names to Lipz
/// codes, and [`import`](crate::import()) assigns them to frames.
#[derive(Clone, PartialEq, Debug, Default)]
#[non_exhaustive]
pub struct Track {
    /// The speaker's name in the file, if it can contain several.
    pub name: Option<String>,
    /// The [mapping table](crate::Map) of its symbols, if the file rather than the format names it.
    pub map: Option<&'static str>,
    /// The shapes. Each lasts until the next one starts.
    pub shapes: Vec<Shape>,
    /// The end of the last shape. Without it, the last shape is held for a frame.
    pub end: Option<Time>,
    /// The frame rate for which the file was made.
    pub rate: Option<Rate>,
    /// The number of the first frame, in formats where it depends on a convention.
    pub first_frame: u64,
    /// The tool's name for rest, for formats that end with it.
    pub rest: Option<String>,
    /// The phrases: stretches of text that belong together, as divided in the file.
    pub phrases: Vec<TimedText>,
    /// The spoken words.
    pub words: Vec<TimedText>,
    /// The spoken texts, with the locale if the file names it. `|` divides segments.
    pub texts: Vec<Text>,
    /// Elements of Lipz files that are copied unchanged, such as events.
    pub elements: Vec<Element<'static>>,
    /// Additional tiers of a TextGrid.
    pub tiers: Vec<Tier>,
    /// Notes on how ambiguous parts of the file were read, one sentence each.
    pub remarks: Vec<String>,
}

/// A mouth shape or a phone, with its start.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Shape {
    /// The start.
    pub start: Time,
    /// Its symbol in the format.
    pub symbol: String,
    /// Its position in the file; `None` in a binary file.
    pub span: Option<Span>,
}

/// A stretch of text, with its start.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct TimedText {
    /// The start.
    pub start: Time,
    /// The spoken words.
    pub text: String,
}

/// The spoken text of a recording.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Text {
    /// The tag of the locale, `en-us`; `None` if the file does not name it.
    pub locale: Option<String>,
    /// The text.
    pub text: String,
}

impl Shape {
    /// Returns a shape from a text file.
    pub fn at(span: Span, start: Time, symbol: impl Into<String>) -> Shape {
        Shape { start, symbol: symbol.into(), span: Some(span) }
    }

    /// Returns a shape from a binary file.
    pub fn new(start: Time, symbol: impl Into<String>) -> Shape {
        Shape { start, symbol: symbol.into(), span: None }
    }
}
