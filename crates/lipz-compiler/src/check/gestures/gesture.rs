//! A gesture in a clip.

use super::shapes::GestureKind;
use lipz_bank::face::FaceCurve;

/// The maximum strength, in thousandths.
pub(super) const MOST: i32 = 10_000;

/// A movement of a face that starts in a frame.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Gesture<'e> {
    pub(super) kind: GestureKind,
    pub(super) frame: u32,
    /// The strength, in thousandths.
    pub(super) strength: i32,
    /// The character; `None` for the speaker.
    pub(super) who: Option<&'e str>,
}

impl Gesture<'_> {
    pub(super) fn new(kind: GestureKind, frame: u32, strength: i32) -> Self {
        Gesture { kind, frame, strength, who: None }
    }

    /// Returns the name of one of its curves. For characters other than the speaker, it starts with the name of the
    /// character.
    pub(super) fn name_of(&self, curve: FaceCurve) -> String {
        self.who.map_or(curve.name().to_owned(), |who| format!("{who}.{}", curve.name()))
    }
}
