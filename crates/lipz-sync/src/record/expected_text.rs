//! The text that a recording should match, from the Lipz files of its clip and its original.

use crate::record::hashes::text_hash;
use crate::record::{OriginalHashes, RecordedText, SyncRecord};
use crate::recordings::Recordings;
use crate::recordings::file_facts::content_hash;
use crate::recordings::transcript::spoken_text;
use lipz_compiler::settings::Settings;
use lipz_file::Document;
use std::fs::File;
use std::path::Path;

/// A clip, or the original of one: its key, and its Lipz file.
pub(crate) type KeyedDocument<'d> = (&'d str, &'d Document<'d>);

/// The text that the recording of a clip should match.
pub(crate) struct ExpectedText<'d> {
    /// In the form of the record.
    pub(crate) now: RecordedText,
    text: Option<&'d str>,
    of_original: Option<&'d str>,
}

impl<'d> ExpectedText<'d> {
    /// Returns the expected text of a clip whose recording has this hash. A dub without a text uses that of its
    /// original.
    pub(crate) fn new(
        settings: &Settings,
        recordings: &Recordings,
        sound: u64,
        clip: KeyedDocument<'d>,
        original: Option<KeyedDocument<'d>>,
    ) -> ExpectedText<'d> {
        let spoken = |(key, document): KeyedDocument<'d>| spoken_text(settings, recordings.locale(key), document);
        let locale = recordings.locale(clip.0);
        let text = spoken(clip).or_else(|| spoken_text(settings, locale, original?.1));
        let of_original = original.and_then(spoken);
        let original = original.map(|(key, _)| {
            let recording = recordings.find(key);
            let sound = recording.and_then(|path| File::open(path).and_then(content_hash).ok()).unwrap_or(0);
            OriginalHashes { sound, text: text_hash(of_original) }
        });
        ExpectedText { now: RecordedText { sound, text: text_hash(text), original }, text, of_original }
    }

    /// Whether there is a text.
    pub(crate) fn has_text(&self) -> bool {
        self.text.is_some()
    }

    /// Returns the recorded texts of the recording.
    pub(crate) fn known(&self, record: &SyncRecord, lipz_file: &Path) -> Vec<RecordedText> {
        record.spoken_now(lipz_file, self.now.sound, self.text, self.of_original)
    }
}
