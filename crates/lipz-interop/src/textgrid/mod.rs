//! Praat TextGrids: tiers of labelled intervals, as written by phoneticians and the Montreal Forced Aligner.
//!
//! [`TextGrid`] is such a file, in the long or the short text form. `clip` makes it a [format](crate::formats): it
//! converts words, phones, mouth shapes and texts of a clip to and from Lipz documents.

pub(crate) mod clip;
mod number;
mod phones;
mod read;
mod roles;
pub(crate) mod symbols;
mod write;

pub use phones::is_silence;
pub use roles::TierChoice;

use crate::Time;
use lipz_diagnostics::Span;

/// A TextGrid: tiers over a stretch of time.
///
/// ```
/// use lipz_interop::textgrid::{Interval, TextGrid, Tier};
/// use lipz_interop::Time;
/// let word = Interval::new(Time::ZERO, Time::new(1, 2), "mayor");
/// let grid = TextGrid { end: Time::new(1, 2), tiers: vec![Tier::new("words", vec![word])], ..TextGrid::default() };
/// let mut diagnostics = Vec::new();
/// let read = TextGrid::read(grid.write().as_bytes(), &mut diagnostics).ok_or("a TextGrid")?;
/// assert_eq!(read.tiers[0].intervals[0].label, "mayor");
/// assert!(diagnostics.is_empty());
/// # Ok::<(), &str>(())
/// ```
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct TextGrid {
    /// The start. Times of intervals are relative to the same zero. A file that starts below 0 is read from its start.
    pub start: Time,
    /// The end.
    pub end: Time,
    /// The tiers, from top to bottom.
    pub tiers: Vec<Tier>,
}

/// A tier: intervals, or points in time, which have no length.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Tier {
    /// The name, `words`.
    pub name: String,
    /// Whether its intervals are points.
    pub has_points: bool,
    /// The intervals, as they are in the file.
    pub intervals: Vec<Interval>,
}

/// A labelled stretch of time.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Interval {
    /// The start.
    pub start: Time,
    /// The end.
    pub end: Time,
    /// The content: a word or a phone; often empty in pauses.
    pub label: String,
    /// The position of the label in the file.
    pub span: Option<Span>,
}

impl Tier {
    /// Returns a tier of intervals.
    pub fn new(name: impl Into<String>, intervals: Vec<Interval>) -> Tier {
        Tier { name: name.into(), has_points: false, intervals }
    }
}

impl Interval {
    /// Returns a labelled stretch of time without a position in a file.
    pub fn new(start: Time, end: Time, label: impl Into<String>) -> Interval {
        Interval { start, end, label: label.into(), span: None }
    }
}
