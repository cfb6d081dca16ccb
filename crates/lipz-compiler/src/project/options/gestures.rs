//! Movements of faces during speech and listening.

/// The conversion of gestures to curves (docs/guides/faces.md).
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub struct Gestures {
    /// The sources of gestures.
    pub keys: GestureKeys,
    /// The default strength of nods and head shakes, in thousandths of 0 to 10.
    pub nods_thousandths: i32,
    /// The depth of a calm face's breath at the end of a sentence, in thousandths of 0 to 10.
    pub breath_thousandths: i32,
}

/// The sources of gestures.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum GestureKeys {
    /// Events: `nods 4`.
    #[default]
    Events,
    /// Events, and the words that are spoken.
    Words,
    /// Nothing.
    Off,
}

impl Default for Gestures {
    fn default() -> Gestures {
        Gestures { keys: GestureKeys::default(), nods_thousandths: 4000, breath_thousandths: 1000 }
    }
}
