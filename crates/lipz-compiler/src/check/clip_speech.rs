//! The locale and the word times of a clip's speech.

use crate::project::{Options, WordTimes};

/// The speech of a clip, as far as it is known.
#[derive(Clone, Copy, Default)]
pub(crate) struct ClipSpeech<'o> {
    /// The locale of the clip's voice. `None` means the default locale.
    pub(super) locale: Option<&'o str>,
    /// The times of the spoken words.
    pub(super) times: Option<&'o WordTimes>,
}

impl<'o> ClipSpeech<'o> {
    /// Returns the speech of the clip with this key.
    pub(crate) fn of(key: &str, options: &'o Options) -> ClipSpeech<'o> {
        ClipSpeech { locale: options.voices.locale_of(key), times: options.word_times.get(key) }
    }
}
