//! What other tools say about a recording, before it becomes a Lipz file: shapes with their times.

use crate::Time;
use crate::textgrid::Tier;
use lipz_diagnostics::Span;
use lipz_file::Element;
use lipz_file::rate::Rate;

/// The mouth shapes of one speaker in one recording, as a file of another tool has them.
///
/// Times are exact, shapes have the names that the tool gives them. Which Lipz code a name stands for is the
/// business of a [`Map`](crate::Map); to which frames it comes, that of [`import`](crate::import()).
#[derive(Clone, PartialEq, Debug, Default)]
#[non_exhaustive]
pub struct Track {
    /// What the file calls the speaker, if it can have several.
    pub name: Option<String>,
    /// The [mapping table](crate::Map) of its symbols, if the file names it and not the format.
    pub map: Option<&'static str>,
    /// The shapes. Each lasts until the next one starts.
    pub shapes: Vec<Shape>,
    /// When the last shape ends; without it, the last shape is held for a frame.
    pub end: Option<Time>,
    /// The frame rate that the file was made for.
    pub rate: Option<Rate>,
    /// The number of the first frame, in formats where it is a convention.
    pub first_frame: u64,
    /// What the tool calls the resting mouth, for formats that end with it.
    pub rest: Option<String>,
    /// Stretches of text that belong together, as the file divides it.
    pub phrases: Vec<Timed>,
    /// The spoken words.
    pub words: Vec<Timed>,
    /// What is said, in the locale if the file names it. `|` in it divides segments.
    pub texts: Vec<Text>,
    /// Elements of Lipz files that are taken as they are, such as events.
    pub elements: Vec<Element<'static>>,
    /// Tiers that a TextGrid gets besides those of the clip.
    pub tiers: Vec<Tier>,
    /// How the file was read where there was a choice, a sentence each.
    pub remarks: Vec<String>,
}

/// A mouth shape or sound from a time on.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Shape {
    /// When it starts.
    pub start: Time,
    /// What the format calls it.
    pub symbol: String,
    /// Where the file says so; `None` in a binary file.
    pub span: Option<Span>,
}

/// A stretch of text from a time on.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Timed {
    /// When it starts.
    pub start: Time,
    /// What is said.
    pub text: String,
}

/// What is said in a recording.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Text {
    /// The tag of the locale, `en-us`; `None` if the file does not name it.
    pub locale: Option<String>,
    /// The text.
    pub text: String,
}

impl Shape {
    /// A shape of a text file.
    pub fn at(span: Span, start: Time, symbol: impl Into<String>) -> Shape {
        Shape { start, symbol: symbol.into(), span: Some(span) }
    }

    /// A shape of a binary file.
    pub fn new(start: Time, symbol: impl Into<String>) -> Shape {
        Shape { start, symbol: symbol.into(), span: None }
    }
}
