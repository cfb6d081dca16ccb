//! What a recording has to say now, by the Lipz files of its clip and of its original.

use crate::facts::content_hash;
use crate::sync::hashes::text_hash;
use crate::{OriginalThen, Recordings, Spoken, SyncRecord, spoken_text};
use lipz_compiler::settings::Settings;
use lipz_file::Document;
use std::fs::File;
use std::path::Path;

/// A clip, or the original of one: its key, and what its Lipz file says.
pub(crate) type Keyed<'d> = (&'d str, &'d Document<'d>);

/// What the recording of a clip has to say now.
pub(crate) struct SpokenNow<'d> {
    /// As the record would have it.
    pub(crate) now: Spoken,
    text: Option<&'d str>,
    of_original: Option<&'d str>,
}

impl<'d> SpokenNow<'d> {
    /// That of a clip with a recording of these bytes. A dub without a text says that of its original.
    pub(crate) fn new(
        settings: &Settings,
        recordings: &Recordings,
        sound: u64,
        clip: Keyed<'d>,
        original: Option<Keyed<'d>>,
    ) -> SpokenNow<'d> {
        let spoken = |(key, document): Keyed<'d>| spoken_text(settings, recordings.locale(key), document);
        let locale = recordings.locale(clip.0);
        let text = spoken(clip).or_else(|| spoken_text(settings, locale, original?.1));
        let of_original = original.and_then(spoken);
        let original = original.map(|(key, _)| {
            let recording = recordings.find(key);
            let sound = recording.and_then(|path| File::open(path).and_then(content_hash).ok()).unwrap_or(0);
            OriginalThen { sound, text: text_hash(of_original) }
        });
        SpokenNow { now: Spoken { sound, text: text_hash(text), original }, text, of_original }
    }

    /// Whether somebody has written down what it has to say.
    pub(crate) fn has_text(&self) -> bool {
        self.text.is_some()
    }

    /// What is known of what the recording says.
    pub(crate) fn known(&self, record: &SyncRecord, lipz_file: &Path) -> Vec<Spoken> {
        record.spoken_now(lipz_file, self.now.sound, self.text, self.of_original)
    }
}
