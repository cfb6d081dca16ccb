//! The data that other tools store about a recording, before it becomes a Lipz file: shapes with times.

use crate::Time;
use crate::textgrid::Tier;
use lipz_diagnostics::Span;
use lipz_file::Element;
use lipz_file::rate::Rate;
use lipz_types::Phone;

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
    /// The phones, if the file has them in addition to its shapes. Without them, shapes of tables for phones count.
    pub phones: Vec<StartedPhone>,
    /// The weights of a recorded face, which become curves.
    pub weights: FaceWeights,
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

/// A phone, with its start. It ends where the next one starts.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct StartedPhone {
    /// The start.
    pub start: Time,
    /// The phone.
    pub phone: Phone,
}

/// The weights of the shapes of a recorded face.
#[derive(Clone, PartialEq, Debug, Default)]
#[non_exhaustive]
pub struct FaceWeights {
    /// The names of the shapes, all different.
    pub names: Vec<String>,
    /// The recorded frames, in the order of the file.
    pub rows: Vec<WeightRow>,
}

/// The weights of a recorded face at a time.
#[derive(Clone, PartialEq, Debug)]
pub struct WeightRow {
    /// The time.
    pub start: Time,
    /// One finite value per name, from -2,000,000 to 2,000,000.
    pub weights: Vec<f32>,
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
