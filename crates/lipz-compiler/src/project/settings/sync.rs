//! The settings of a project for the visemes made from its recordings.

use std::path::PathBuf;

/// The rules for making visemes from recordings. Values that are `None` use the defaults of the library.
#[derive(Clone, PartialEq, Debug, Default)]
#[non_exhaustive]
pub struct Sync {
    /// A file with the pronunciations of the project's own words.
    pub lexicon: Option<PathBuf>,
    /// A file with a model of the project's own voices.
    pub model: Option<PathBuf>,
    /// A file with a neural network that recognises phones, for recordings without a text.
    pub recogniser: Option<PathBuf>,
    /// The folder of TextGrids with the times of words and phones, for correction by hand.
    pub textgrids: Option<PathBuf>,
    /// The time in milliseconds by which a viseme precedes its phone.
    pub lead_ms: Option<u32>,
    /// The minimum time in milliseconds of closed lips, and of the lip under the teeth.
    pub hold_ms: Option<u32>,
    /// Whether the visemes of other consonants are held as long, as far as neighbouring vowels allow.
    pub hold_consonants: bool,
    /// Whether Lipz files get the phones of their recordings.
    pub phones: bool,
    /// The time in milliseconds below which a vowel does not open the mouth wide.
    pub shortest_wide_ms: Option<u32>,
    /// The level in decibels below the loud parts of a recording at which an `rms` mouth is closed.
    pub rms_threshold_db: Option<f64>,
    /// The exponent that maps the amplitude to the opening of an `rms` mouth; 1 for proportional.
    pub rms_exponent: Option<f64>,
    /// The time in milliseconds below which a pause does not bring the mouth to rest.
    pub shortest_pause_ms: Option<u32>,
}
