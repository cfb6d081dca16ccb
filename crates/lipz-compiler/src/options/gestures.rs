//! What faces do while something is said or heard.

/// How gestures become curves (docs/guides/faces.md).
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub struct Gestures {
    /// What makes them.
    pub keys: GestureKeys,
    /// How far a head nods and shakes that nobody has said more about: thousandths of 0 to 10.
    pub nods_thousandths: i32,
    /// How deep a calm face breathes at the end of a sentence: thousandths of 0 to 10.
    pub breath_thousandths: i32,
}

/// What makes gestures.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum GestureKeys {
    /// Events: `nods 4`.
    #[default]
    Events,
    /// Events, and what is said and heard.
    Words,
    /// Nothing.
    Off,
}

impl Default for Gestures {
    fn default() -> Gestures {
        Gestures { keys: GestureKeys::default(), nods_thousandths: 4000, breath_thousandths: 1000 }
    }
}
