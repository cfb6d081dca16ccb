//! The options of an import.

use crate::segments::Segments;
use crate::textgrid::TierChoice;
use crate::{Map, Time};
use lipz_file::rate::Rate;
use lipz_types::VisemeType;

/// The frame rate of clips if neither the file nor the project sets one. Rhubarb, Moho and Pamela use the same rate.
pub const DEFAULT_RATE: Rate = Rate { numerator: 24, denominator: 1, is_exact: true };

/// The options of an import.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct ImportOptions<'a> {
    /// The table to use instead of the one of the format.
    pub map: Option<&'a Map>,
    /// The viseme type of the clips, which selects one of the format's tables. The default is the first table.
    pub viseme_type: Option<VisemeType>,
    /// The frame rate of the clips. The default is that of the file.
    pub rate: Option<Rate>,
    /// The frame rate of clips if neither of them is set.
    pub default_rate: Rate,
    /// The frame rate of files that count frames but do not state a rate.
    pub file_rate: Option<Rate>,
    /// The name of the file without folders and extension, for formats that store it.
    pub name: Option<&'a str>,
    /// The units per second of a Fallout file. The default is derived from the length of the recording, or is that of
    /// the engine.
    pub units_per_second: Option<u32>,
    /// The length of the recording.
    pub sound_length: Option<Time>,
    /// The tiers of a TextGrid whose names do not state their content.
    pub tiers: &'a [TierChoice],
    /// The number of the first frame in Moho files, 0 or 1.
    pub dat_base: u64,
    /// The codes of the lip-sync track, one per frame, instead of the shapes of the file. For files with one speaker.
    pub codes: Option<&'a str>,
    /// The least number of frames of a shape.
    pub min_hold: usize,
    /// The spoken text. The default is that of the file.
    pub text: Option<&'a str>,
    /// The locale of the text, `en-us`.
    pub locale: Option<&'a str>,
    /// The method of dividing clips.
    pub segments: Segments,
    /// The shortest rest that counts as a pause.
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
            tiers: &[],
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
    /// Returns the default options.
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

    /// Sets the frame rate of clips if neither the file nor the project sets one.
    #[must_use]
    pub fn default_rate(self, default_rate: Rate) -> Self {
        ImportOptions { default_rate, ..self }
    }

    /// Sets the frame rate of files that only count frames.
    #[must_use]
    pub fn file_rate(self, file_rate: impl Into<Option<Rate>>) -> Self {
        ImportOptions { file_rate: file_rate.into(), ..self }
    }

    /// Sets the name of the file without folders and extension.
    #[must_use]
    pub fn name(self, name: impl Into<Option<&'a str>>) -> Self {
        ImportOptions { name: name.into(), ..self }
    }

    /// Sets the units per second of a Fallout file.
    #[must_use]
    pub fn units_per_second(self, units_per_second: impl Into<Option<u32>>) -> Self {
        ImportOptions { units_per_second: units_per_second.into(), ..self }
    }

    /// Sets the length of the recording.
    #[must_use]
    pub fn sound_length(self, sound_length: impl Into<Option<Time>>) -> Self {
        ImportOptions { sound_length: sound_length.into(), ..self }
    }

    /// Sets the tiers of a TextGrid whose names do not state their content.
    #[must_use]
    pub fn tiers(self, tiers: &'a [TierChoice]) -> Self {
        ImportOptions { tiers, ..self }
    }

    /// Sets the number of the first frame in Moho files, 0 or 1.
    #[must_use]
    pub fn dat_base(self, dat_base: u64) -> Self {
        ImportOptions { dat_base, ..self }
    }

    /// Sets the codes of the lip-sync track, one per frame.
    #[must_use]
    pub fn codes(self, codes: impl Into<Option<&'a str>>) -> Self {
        ImportOptions { codes: codes.into(), ..self }
    }

    /// Sets the least number of frames of a shape.
    #[must_use]
    pub fn min_hold(self, min_hold: usize) -> Self {
        ImportOptions { min_hold, ..self }
    }

    /// Sets the spoken text.
    #[must_use]
    pub fn text(self, text: impl Into<Option<&'a str>>) -> Self {
        ImportOptions { text: text.into(), ..self }
    }

    /// Sets the locale of the text, `en-us`.
    #[must_use]
    pub fn locale(self, locale: impl Into<Option<&'a str>>) -> Self {
        ImportOptions { locale: locale.into(), ..self }
    }

    /// Sets the method of dividing clips.
    #[must_use]
    pub fn segments(self, segments: Segments) -> Self {
        ImportOptions { segments, ..self }
    }

    /// Sets the shortest rest that counts as a pause.
    #[must_use]
    pub fn min_pause(self, min_pause: Time) -> Self {
        ImportOptions { min_pause, ..self }
    }
}
