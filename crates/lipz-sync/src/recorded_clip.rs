//! What is known of the recording of one clip.

use crate::clip::Clip;
use crate::facts::{content_hash, length_us, unreadable};
use crate::lints::bytes_of;
use crate::originals::Originals;
use crate::recordings::shown;
use crate::sync::hashes::{mouth_hash, text_hash};
use crate::{DoubtfulWord, Line, Recordings, SyncRecord, record_place, spoken_text};
use lipz_compiler::settings::Settings;
use lipz_compiler::{Content, Input};
use lipz_diagnostics::Report;
use lipz_types::VisemeType;
use std::fs::File;
use std::path::{Path, PathBuf};

/// The recording of a clip, and what its mouth has to do with it.
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub struct RecordedClip {
    /// The file, as messages name it.
    pub path: String,
    /// Its length, in microseconds.
    pub length_us: u64,
    /// Where its mouth comes from.
    pub state: SyncState,
    /// Words that were not clearly heard, if the mouth was made of this recording and this text.
    pub doubtful: Vec<DoubtfulWord>,
    /// Its recordings in other languages, by their locales; `None` where there is none.
    pub dubs: Vec<(String, Option<String>)>,
}

/// Where the mouth of a clip comes from.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[non_exhaustive]
pub enum SyncState {
    /// There is no mouth, or it rests in every frame.
    NoMouth,
    /// It was drawn by hand, or made by another tool.
    ByHand,
    /// It was made of this recording.
    Synced,
    /// It was made from a TextGrid of this recording that somebody had corrected.
    Corrected,
    /// It was changed by hand after it had been made.
    Changed,
    /// It was made of another recording.
    OtherRecording,
    /// It was made of this recording, for another text.
    OtherText,
}

impl SyncState {
    /// A name for programs.
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

    /// The same in words, about the mouth.
    pub fn describe(self) -> &'static str {
        match self {
            SyncState::NoMouth => "the clip has no mouth yet",
            SyncState::ByHand => "the mouth was drawn by hand, or made by another tool",
            SyncState::Synced => "the mouth was made of it",
            SyncState::Corrected => "the mouth was made from a corrected TextGrid of it",
            SyncState::Changed => "the mouth was made of a recording, and then changed by hand",
            SyncState::OtherRecording => "the mouth was made of another recording",
            SyncState::OtherText => "the mouth was made of it, for another text",
        }
    }
}

impl RecordedClip {
    /// What is known of a clip; `None` if the project has no recordings, or the clip has none.
    ///
    /// # Errors
    /// If the recording, or the record of what mouths were made from, cannot be read.
    pub fn find(settings: &Settings, inputs: &[Input], key: &str) -> Result<Option<RecordedClip>, Report> {
        // Folders that cannot be read are for `check`.
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

/// Where the mouth comes from, and the words that were not clearly heard.
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
    let clip = Clip::from_document(&document, &settings.options);
    if clip.codes.iter().all(|code| *code == b'-') {
        return Ok((SyncState::NoMouth, Vec::new()));
    }
    let own_type = document.string("viseme_type").and_then(|name| name.parse::<VisemeType>().ok());
    let mouth = mouth_hash(&clip.codes, clip.fps, own_type.or(settings.options.get_default_viseme_type()));
    let (sound, text) =
        (File::open(path).and_then(content_hash).map_err(|error| unreadable(path, &error))?, text_hash(spoken));
    let known: Vec<Line> = record.lines_for(&lipz_file).iter().map(|line| line.renewed(spoken)).collect();
    let found = |is: &dyn Fn(&&Line) -> bool| known.iter().rev().find(is);
    let is_mouth = |line: &&Line| line.made.mouth == mouth;
    let is_sound = |line: &&Line| line.made.sound == sound;
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
