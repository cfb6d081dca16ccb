//! What a project decides about the mouth shapes that are made of its recordings.

use std::path::PathBuf;

/// How mouth shapes are made of recordings. What is `None` is as the library has it.
#[derive(Clone, PartialEq, Debug, Default)]
#[non_exhaustive]
pub struct Sync {
    /// A file with the pronunciations of the project's own words.
    pub lexicon: Option<PathBuf>,
    /// A file with a model of the project's own voices.
    pub model: Option<PathBuf>,
    /// A file with a neural network that hears phones, for recordings without a text.
    pub recogniser: Option<PathBuf>,
    /// The folder of TextGrids with the times of words and phones, for correction by hand.
    pub textgrids: Option<PathBuf>,
    /// Milliseconds by which a shape is ahead of its sound.
    pub lead_ms: Option<u32>,
    /// Milliseconds for which closed lips, and the lip under the teeth, stay at least.
    pub hold_ms: Option<u32>,
    /// Whether the shapes of other consonants stay as long, as far as vowels have time to spare.
    pub hold_consonants: bool,
    /// Milliseconds below which a vowel does not open the mouth wide.
    pub shortest_wide_ms: Option<u32>,
    /// Decibels below the loud parts of a recording at which a mouth of loudness (`rms`) is closed.
    pub rms_threshold_db: Option<f64>,
    /// How far a mouth of loudness opens with the amplitude: 1 in proportion.
    pub rms_exponent: Option<f64>,
    /// Milliseconds below which a pause does not bring the mouth to rest.
    pub shortest_pause_ms: Option<u32>,
}
