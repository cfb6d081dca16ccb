//! The recording of one clip and its relation to the visemes.

use crate::record::hashes::{mouth_hash, text_hash};
use crate::record::{DoubtfulWord, RecordLine, SyncRecord, record_place};
use crate::recordings::Recordings;
use crate::recordings::clip::ClipMouth;
use crate::recordings::file_facts::{content_hash, length_us, unreadable};
use crate::recordings::inputs::bytes_of;
use crate::recordings::originals::Originals;
use crate::recordings::paths::shown;
use crate::recordings::transcript::spoken_text;
use lipz_compiler::settings::Settings;
use lipz_compiler::{Content, Input};
use lipz_diagnostics::Report;
use lipz_types::VisemeType;
use std::fs::File;
use std::path::{Path, PathBuf};

/// The recording of a clip, and its relation to the visemes.
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub struct RecordedClip {
    /// The path of the file, as in messages.
    pub path: String,
    /// The length, in microseconds.
    pub length_us: u64,
    /// The source of the visemes.
    pub state: SyncState,
    /// The unclear words, if the visemes were made from this recording and this text.
    pub doubtful: Vec<DoubtfulWord>,
    /// The recordings in other languages, by locale; `None` for missing ones.
    pub dubs: Vec<(String, Option<String>)>,
}

/// The source of a clip's visemes.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[non_exhaustive]
pub enum SyncState {
    /// There are no visemes, or all of them are rest.
    NoMouth,
    /// They were made by hand, or by a different tool.
    ByHand,
    /// They were made from this recording.
    Synced,
    /// They were made from a corrected TextGrid of this recording.
    Corrected,
    /// They were edited by hand after lip sync.
    Changed,
    /// They were made from a different recording.
    OtherRecording,
    /// They were made from this recording, for a different text.
    OtherText,
}

impl SyncState {
    /// Returns a name for programs.
    pub fn name(self) -> &'static str {
        match self {
            SyncState::NoMouth => "no-mouth",
            SyncState::ByHand => "by-hand",
            SyncState::Synced => "synced",
            SyncState::Corrected => "corrected",
            SyncState::Changed => "changed",
            SyncState::OtherRecording => "other-recording",
            SyncState::OtherText => "other-text",
        }
    }

    /// Returns a description of the visemes.
    pub fn describe(self) -> &'static str {
        match self {
            SyncState::NoMouth => "the clip has no visemes yet",
            SyncState::ByHand => "the visemes were made by hand or by another tool",
            SyncState::Synced => "the visemes were made from it",
            SyncState::Corrected => "the visemes were made from a corrected TextGrid of it",
            SyncState::Changed => "the visemes were made from a recording and then edited by hand",
            SyncState::OtherRecording => "the visemes were made from a different recording",
            SyncState::OtherText => "the visemes were made from it, but for a different text",
        }
    }
}

impl RecordedClip {
    /// Returns the recording of a clip; `None` if the project has no recordings, or the clip has none.
    ///
    /// # Errors
    /// If the recording, or the record of the visemes' sources, cannot be read.
    pub fn find(settings: &Settings, inputs: &[Input], key: &str) -> Result<Option<RecordedClip>, Report> {
        // `check` reports unreadable folders.
        let (recordings, _) = Recordings::discover_with_reports(settings);
        let (Some(path), Some(input)) = (recordings.find(key), inputs.iter().find(|input| input.key == key)) else {
            return Ok(None);
        };
        let record = SyncRecord::read(&record_place(settings))?;
        let length_us = length_us(path)?;
        let (state, doubtful) = state(settings, (inputs, input), &recordings, path, &record)?;
        let dubs = recordings.dubs(key).into_iter().map(|(locale, path)| (locale.to_owned(), path.map(shown)));
        Ok(Some(RecordedClip { path: shown(path), length_us, state, doubtful, dubs: dubs.collect() }))
    }
}

/// Returns the source of the visemes, and the unclear words.
fn state(
    settings: &Settings,
    (inputs, input): (&[Input], &Input),
    recordings: &Recordings,
    path: &Path,
    record: &SyncRecord,
) -> Result<(SyncState, Vec<DoubtfulWord>), Report> {
    let lipz_file = match &input.content {
        Content::File(path) => path.clone(),
        Content::Bytes { name, .. } => PathBuf::from(name),
    };
    let bytes = bytes_of(input).unwrap_or_default();
    let Some(document) = lipz_file::parse(&bytes).document else { return Ok((SyncState::NoMouth, Vec::new())) };
    let original = Originals::new(recordings.voices(), inputs).of(&input.key, &lipz_file);
    let original_bytes = original.as_deref().and_then(bytes_of).unwrap_or_default();
    let original = lipz_file::parse(&original_bytes).document;
    let locale = recordings.locale(&input.key);
    let spoken = spoken_text(settings, locale, &document).or_else(|| spoken_text(settings, locale, original.as_ref()?));
    let clip = ClipMouth::from_document(&document, &settings.options);
    if clip.codes.iter().all(|code| *code == b'-') {
        return Ok((SyncState::NoMouth, Vec::new()));
    }
    let own_type = document.string("viseme_type").and_then(|name| name.parse::<VisemeType>().ok());
    let mouth = mouth_hash(&clip.codes, clip.fps, own_type.or(settings.options.get_default_viseme_type()));
    let (sound, text) =
        (File::open(path).and_then(content_hash).map_err(|error| unreadable(path, &error))?, text_hash(spoken));
    let known: Vec<RecordLine> = record.lines_for(&lipz_file).iter().map(|line| line.renewed(spoken)).collect();
    let found = |is: &dyn Fn(&&RecordLine) -> bool| known.iter().rev().find(is);
    let is_mouth = |line: &&RecordLine| line.made.mouth == mouth;
    let is_sound = |line: &&RecordLine| line.made.sound == sound;
    let current = found(&|line| is_mouth(line) && is_sound(line) && line.made.text == text);
    let state = match current {
        _ if known.is_empty() => SyncState::ByHand,
        Some(line) if line.is_corrected => SyncState::Corrected,
        Some(_) => SyncState::Synced,
        None if found(&is_mouth).is_none() => SyncState::Changed,
        None if found(&|line| is_mouth(line) && is_sound(line)).is_some() => SyncState::OtherText,
        None => SyncState::OtherRecording,
    };
    let of_sound = current.or_else(|| found(&|line| is_sound(line)));
    let words = of_sound.and_then(|line| line.words.as_ref()).zip(spoken);
    let words = words.map(|(words, text)| words.of_text(text).into_iter().map(move |word| (word, text)));
    let doubtful = words.into_iter().flatten().filter(|(word, _)| word.is_doubtful).filter_map(|(word, text)| {
        let start_us = u64::from(word.start_ms) * 1000;
        Some(DoubtfulWord { key: input.key.clone(), start_us, word: text.get(word.range)?.to_owned() })
    });
    Ok((state, doubtful.collect()))
}
