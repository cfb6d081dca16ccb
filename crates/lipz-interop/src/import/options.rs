//! What is decided about an import.

use crate::segments::Segments;
use crate::{Map, Time};
use lipz_file::rate::Rate;
use lipz_types::VisemeType;

/// The frame rate of clips if neither the file nor the project tells one: that of Rhubarb, Moho and Pamela.
pub const DEFAULT_RATE: Rate = Rate { numerator: 24, denominator: 1, is_exact: true };

/// What a project and a person decide about an import.
#[derive(Clone, Debug)]
pub struct ImportOptions<'a> {
    /// The table to use instead of the one of the format.
    pub map: Option<&'a Map>,
    /// The viseme type of the clips, which chooses among the tables of the format; without it, the first one.
    pub viseme_type: Option<VisemeType>,
    /// The frame rate of the clips; without it, that of the file.
    pub rate: Option<Rate>,
    /// The frame rate of clips if neither is told.
    pub default_rate: Rate,
    /// Frames a second of files that count frames and do not say how many are a second.
    pub file_rate: Option<Rate>,
    /// The name of the file without folders and extension, for formats that have it in the file, too.
    pub name: Option<&'a str>,
    /// What a second has of the units in which a Fallout file counts; without it, what the length of the sound
    /// tells, or what the engine plays.
    pub units_per_second: Option<u32>,
    /// How long the recording is.
    pub sound_length: Option<Time>,
    /// The number of the first frame in Moho files, 0 or 1.
    pub dat_base: u64,
    /// Frames for which a shape is shown at least.
    pub min_hold: usize,
    /// What is said; without it, what the file has.
    pub text: Option<&'a str>,
    /// The locale of the text, `en-us`.
    pub locale: Option<&'a str>,
    /// Where clips are divided.
    pub segments: Segments,
    /// The shortest rest of the mouth that is a pause.
    pub min_pause: Time,
}

impl Default for ImportOptions<'_> {
    fn default() -> Self {
        ImportOptions {
            map: None,
            viseme_type: None,
            rate: None,
            default_rate: DEFAULT_RATE,
            file_rate: None,
            name: None,
            units_per_second: None,
            sound_length: None,
            dat_base: 1,
            min_hold: 1,
            text: None,
            locale: None,
            segments: Segments::default(),
            min_pause: Time::new(300, 1000),
        }
    }
}
