//! Conversion of a recording and its script to frames, and the words to check by ear.

use crate::job::progress::Progress;
use crate::job::{SyncOptions, grid, phone_track, soft_opening};
use lipz_compiler::{WordTime, WordTimes};
use lipz_diagnostics::{Code, Diagnostic, Report, escape};
use lipz_file::JsonString;
use lipz_speech::{
    AlignedPhone, AlignedWord, Aligner, Alignment, Mismatch, MismatchKind, Model, Script, Sound, render, rms,
};
use lipz_types::{CurveValue, Fps, VisemeType};
use std::ops::Range;

/// The confidence below which a word is doubtful.
const DOUBTFUL: f32 = 0.5;

/// The result of analysing a recording.
#[derive(Default)]
pub(super) struct HeardMouth {
    /// The codes of the frames.
    pub(super) codes: String,
    /// The first frame of each segment.
    pub(super) segment_starts: Vec<usize>,
    /// The times of the script's words.
    words: Vec<AlignedWord>,
    /// All phones and pauses; empty if the visemes follow the loudness.
    pub(super) phones: Vec<AlignedPhone>,
    /// The doubtful words of the script: index, and start in microseconds.
    pub(super) doubtful: Vec<(usize, u64)>,
    /// The mismatches between audio and script.
    mismatches: Vec<Mismatch>,
    /// The value of the element `phones`, if there are phones.
    pub(super) phone_track: Option<String>,
    /// The keys of the opening of the lips, if the recording has no text and the project wants phones.
    pub(super) opening: Vec<(u32, CurveValue)>,
    /// The alignment and the visemes, as a TextGrid.
    pub(super) grid: Option<String>,
}

impl HeardMouth {
    /// Whether the text was found in the recording: it has words, of which most are certain, and all match.
    pub(super) fn is_said(&self) -> bool {
        self.mismatches.is_empty() && 2 * self.doubtful.len() < self.words.len()
    }

    /// Drops the doubtful words.
    pub(super) fn forget_words(&mut self) {
        self.words.clear();
        self.doubtful.clear();
        self.mismatches.clear();
    }
}

/// The input of an analysis.
pub(super) struct Hearing<'a> {
    pub(super) sound: &'a Sound,
    pub(super) model: &'a Model,
    /// Whether there is no text, so that the script has only phones that a recogniser found, or is empty.
    pub(super) is_unwritten: bool,
    /// Returns the places where audio and script differ.
    pub(super) mismatches: &'a dyn Fn(&Alignment) -> Result<Vec<Mismatch>, Report>,
    /// A corrected alignment, which replaces the analysis.
    pub(super) corrected: Option<Alignment>,
    /// Whether a TextGrid is wanted.
    pub(super) with_grid: bool,
    pub(super) progress: &'a Progress<'a>,
}

/// Returns the visemes of a recording.
///
/// # Errors
/// If the recording can no longer be read, to compare it with its script.
pub(super) fn make(
    hearing: Hearing<'_>,
    script: &Script,
    (viseme_type, fps): (VisemeType, Fps),
    options: &SyncOptions,
) -> Result<HeardMouth, Report> {
    let Hearing { sound, model, is_unwritten, mismatches, corrected, with_grid, progress } = hearing;
    if viseme_type == VisemeType::Rms {
        let mouth = rms(sound, fps, &options.rms);
        return Ok(HeardMouth { codes: mouth.frames, segment_starts: mouth.segment_starts, ..HeardMouth::default() });
    }
    let progress = |share| progress.heard(share);
    let aligner = Aligner::new(model, options.align).with_progress(&progress);
    // Without words, all phones are recognised freely.
    let listen = || match script.words.is_empty() {
        true => aligner.listen(sound),
        false => aligner.align(sound, script),
    };
    let alignment = corrected.unwrap_or_else(listen);
    let mouth = render(&alignment, fps, viseme_type, &options.rules);
    let doubtful = doubtful(&alignment, script);
    let mismatches = mismatches(&alignment)?;
    let grid = with_grid.then(|| grid::written(&alignment, script, &mouth.frames, (viseme_type, fps)));
    let (codes, segment_starts) = (mouth.frames, mouth.segment_starts);
    let Alignment { words, phones, .. } = alignment;
    let phone_track = phone_track::text(&phones, is_unwritten, sound.level_db());
    let opening = match is_unwritten && options.phones && phone_track.is_some() {
        true => soft_opening::keys(&aligner, sound, &phones, fps, codes.len()),
        false => Vec::new(),
    };
    Ok(HeardMouth { codes, segment_starts, words, phones, phone_track, opening, doubtful, mismatches, grid })
}

/// Returns the times of the words of `text`, from which `script` was made.
pub(super) fn word_times(heard: &HeardMouth, script: &Script, text: &str) -> WordTimes {
    let ms = |us: u64| u32::try_from(us / 1000).unwrap_or(u32::MAX);
    let mut times: Vec<WordTime> = Vec::new();
    // A missing word is doubtful, and takes no time.
    let said = heard.words.iter().zip(&script.words).filter(|(_, word)| !word.pronunciations.is_empty());
    for (aligned, word) in said {
        let is_doubtful = aligned.confidence < DOUBTFUL;
        match times.last_mut().filter(|last| last.range == word.range) {
            // A number consists of several words.
            Some(last) => {
                last.end_ms = ms(aligned.end_us);
                last.is_doubtful |= is_doubtful;
            }
            None => times.push(WordTime {
                range: word.range.clone(),
                start_ms: ms(aligned.start_us),
                end_ms: ms(aligned.end_us),
                is_doubtful,
            }),
        }
    }
    WordTimes::new(text, &times)
}

fn doubtful(alignment: &Alignment, script: &Script) -> Vec<(usize, u64)> {
    let words = alignment.words.iter().zip(&script.words).enumerate();
    let is_said = words.filter(|(_, (_, word))| !word.pronunciations.is_empty());
    let doubtful = is_said.filter(|(_, (word, _))| word.confidence < DOUBTFUL);
    doubtful.map(|(number, (word, _))| (number, word.start_us)).collect()
}

/// Returns the mismatches between audio and `text` in the form of the record: as word times. Speech that is not in the
/// text has no bytes; missing words are doubtful.
pub(super) fn differences(heard: &HeardMouth, script: &Script, text: &str) -> Option<WordTimes> {
    let ms = |us: u64| u32::try_from(us / 1000).unwrap_or(u32::MAX);
    let found = heard.mismatches.iter().map(|found| WordTime {
        range: place(found, script, text),
        start_ms: ms(found.start_us),
        end_ms: ms(found.end_us),
        is_doubtful: found.kind == MismatchKind::NotSaid,
    });
    let found: Vec<WordTime> = found.collect();
    (!found.is_empty()).then(|| WordTimes::new(text, &found))
}

/// Returns the bytes of the text to which a mismatch applies.
fn place(found: &Mismatch, script: &Script, text: &str) -> Range<usize> {
    let words = script.words.get(found.words.clone()).unwrap_or_default();
    match (words.first(), words.last()) {
        (Some(first), Some(last)) => first.range.start..last.range.end.max(first.range.start),
        // Between two words: the start of the next one.
        _ => {
            let at = script.words.get(found.words.start).map_or(text.len(), |next| next.range.start);
            at..at
        }
    }
}

/// Reports the mismatches between audio and text.
pub(crate) fn mismatches(differences: Option<&WordTimes>, text: &JsonString<'_>) -> Vec<Diagnostic> {
    let found = differences.map(|differences| differences.of_text(&text.text)).unwrap_or_default();
    found.iter().map(|found| mismatch(found, text)).collect()
}

fn mismatch(found: &WordTime, text: &JsonString<'_>) -> Diagnostic {
    let seconds = |ms: u32| format!("{:.2} s", f64::from(ms) / 1e3);
    let time = match found.end_ms == found.start_ms {
        true => format!("at {}", seconds(found.start_ms)),
        false => format!("from {} to {}", seconds(found.start_ms), seconds(found.end_ms)),
    };
    let written = || escape::quoted(text.text.get(found.range.clone()).unwrap_or_default());
    let (message, help) = match (found.is_doubtful, found.range.is_empty()) {
        (true, _) => (format!("{} is not spoken; expected {time}", written()), "remove it from the text, or record it"),
        (_, true) => {
            (format!("the speech {time} is not in the text"), "add it to the text, or cut it from the recording")
        }
        _ => (
            format!("{time}, the recording differs from {}", written()),
            "check whether this text belongs to the recording; for an unusual pronunciation use `{say: …}` or the \
                lexicon",
        ),
    };
    Diagnostic::at(Code::TextMismatch, text.span_of(found.range.clone()), message).help(help)
}
