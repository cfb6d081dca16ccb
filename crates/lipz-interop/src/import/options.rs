//! What is decided about an import.

use crate::segments::Segments;
use crate::{Map, Time};
use lipz_file::rate::Rate;
use lipz_types::VisemeType;

/// The frame rate of clips if neither the file nor the project sets one: that of Rhubarb, Moho and Pamela.
pub const DEFAULT_RATE: Rate = Rate { numerator: 24, denominator: 1, is_exact: true };

/// What a project and a person decide about an import.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct ImportOptions<'a> {
    /// The table to use instead of the one of the format.
    pub map: Option<&'a Map>,
    /// The viseme type of the clips, which chooses among the tables of the format; without it, the first one.
    pub viseme_type: Option<VisemeType>,
    /// The frame rate of the clips; without it, that of the file.
    pub rate: Option<Rate>,
    /// The frame rate of clips if neither is set.
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
    /// The codes of the mouth, one per frame; without them, the shapes of the file are. For files with one speaker.
    pub codes: Option<&'a str>,
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
            codes: None,
            min_hold: 1,
            text: None,
            locale: None,
            segments: Segments::default(),
            min_pause: Time::new(300, 1000),
        }
    }
}

/// Setters; each takes a value or an `Option`.
impl<'a> ImportOptions<'a> {
    /// The usual decisions.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Sets the table to use instead of the one of the format.
    #[must_use]
    pub fn map(self, map: impl Into<Option<&'a Map>>) -> Self {
        ImportOptions { map: map.into(), ..self }
    }

    /// Sets the viseme type of the clips.
    #[must_use]
    pub fn viseme_type(self, viseme_type: impl Into<Option<VisemeType>>) -> Self {
        ImportOptions { viseme_type: viseme_type.into(), ..self }
    }

    /// Sets the frame rate of the clips.
    #[must_use]
    pub fn rate(self, rate: impl Into<Option<Rate>>) -> Self {
        ImportOptions { rate: rate.into(), ..self }
    }

    /// Sets the frame rate of clips if neither is known.
    #[must_use]
    pub fn default_rate(self, default_rate: Rate) -> Self {
        ImportOptions { default_rate, ..self }
    }

    /// Sets the frames a second of files that only count frames.
    #[must_use]
    pub fn file_rate(self, file_rate: impl Into<Option<Rate>>) -> Self {
        ImportOptions { file_rate: file_rate.into(), ..self }
    }

    /// Sets the name of the file without folders and extension.
    #[must_use]
    pub fn name(self, name: impl Into<Option<&'a str>>) -> Self {
        ImportOptions { name: name.into(), ..self }
    }

    /// Sets how many units of a Fallout file a second has.
    #[must_use]
    pub fn units_per_second(self, units_per_second: impl Into<Option<u32>>) -> Self {
        ImportOptions { units_per_second: units_per_second.into(), ..self }
    }

    /// Sets how long the recording is.
    #[must_use]
    pub fn sound_length(self, sound_length: impl Into<Option<Time>>) -> Self {
        ImportOptions { sound_length: sound_length.into(), ..self }
    }

    /// Sets the number of the first frame in Moho files, 0 or 1.
    #[must_use]
    pub fn dat_base(self, dat_base: u64) -> Self {
        ImportOptions { dat_base, ..self }
    }

    /// Sets the codes of the mouth, one per frame.
    #[must_use]
    pub fn codes(self, codes: impl Into<Option<&'a str>>) -> Self {
        ImportOptions { codes: codes.into(), ..self }
    }

    /// Sets the frames for which a shape is shown at least.
    #[must_use]
    pub fn min_hold(self, min_hold: usize) -> Self {
        ImportOptions { min_hold, ..self }
    }

    /// Sets what is said.
    #[must_use]
    pub fn text(self, text: impl Into<Option<&'a str>>) -> Self {
        ImportOptions { text: text.into(), ..self }
    }

    /// Sets the locale of the text, `en-us`.
    #[must_use]
    pub fn locale(self, locale: impl Into<Option<&'a str>>) -> Self {
        ImportOptions { locale: locale.into(), ..self }
    }

    /// Sets where clips are divided.
    #[must_use]
    pub fn segments(self, segments: Segments) -> Self {
        ImportOptions { segments, ..self }
    }

    /// Sets the shortest rest of the mouth that is a pause.
    #[must_use]
    pub fn min_pause(self, min_pause: Time) -> Self {
        ImportOptions { min_pause, ..self }
    }
}
