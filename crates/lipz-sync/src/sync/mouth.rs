//! From sound and script to frames, and where somebody should listen.

use super::progress::Progress;
use super::{SyncOptions, grid};
use lipz_compiler::{WordTime, WordTimes};
use lipz_diagnostics::{Code, Diagnostic, escape};
use lipz_file::JsonString;
use lipz_speech::{
    AlignedPhone, AlignedWord, Aligner, Alignment, Mismatch, MismatchKind, Model, Script, Sound, render, rms,
};
use lipz_types::{Fps, VisemeType};
use std::ops::Range;

/// Confidence below which a word is doubtful.
const DOUBTFUL: f32 = 0.5;

/// What was heard.
#[derive(Default)]
pub(super) struct Heard {
    /// The codes of the frames.
    pub(super) codes: String,
    /// The first frame of each segment.
    pub(super) segment_starts: Vec<usize>,
    /// The words of the script, when they are said.
    words: Vec<AlignedWord>,
    /// All phones and pauses; none of a mouth that follows the loudness.
    pub(super) phones: Vec<AlignedPhone>,
    /// The words of the script of which nobody is sure: number and start in microseconds.
    pub(super) doubtful: Vec<(usize, u64)>,
    /// Where sound and script do not belong together.
    mismatches: Vec<Mismatch>,
    /// All of it, as a TextGrid.
    pub(super) grid: Option<String>,
}

impl Heard {
    /// Forgets which words are doubtful.
    pub(super) fn forget_words(&mut self) {
        self.words.clear();
        self.doubtful.clear();
        self.mismatches.clear();
    }
}

/// What is listened to, and with what.
pub(super) struct Hearing<'a> {
    pub(super) sound: &'a Sound,
    pub(super) model: &'a Model,
    /// What a recogniser hears in it, if there is one: whether that is what the script says.
    pub(super) opinion: Option<&'a lipz_speech::Heard>,
    /// What somebody has corrected: then nothing is listened to.
    pub(super) corrected: Option<Alignment>,
    /// Whether somebody wants the TextGrid.
    pub(super) with_grid: bool,
    pub(super) progress: &'a Progress<'a>,
}

/// The mouth of a sound.
pub(super) fn make(
    hearing: Hearing<'_>,
    script: &Script,
    (viseme_type, fps): (VisemeType, Fps),
    options: &SyncOptions,
) -> Heard {
    let Hearing { sound, model, opinion, corrected, with_grid, progress } = hearing;
    if viseme_type == VisemeType::Rms {
        let mouth = rms(sound, fps, &options.rms);
        return Heard { codes: mouth.frames, segment_starts: mouth.segment_starts, ..Heard::default() };
    }
    let progress = |share| progress.heard(share);
    let aligner = Aligner::new(model, options.align).with_progress(&progress);
    // Without words, whatever phones are heard.
    let (is_corrected, is_unwritten) = (corrected.is_some(), script.words.is_empty());
    let listen = || if is_unwritten { aligner.listen(sound) } else { aligner.align(sound, script) };
    let alignment = corrected.unwrap_or_else(listen);
    let mouth = render(&alignment, fps, viseme_type, &options.rules);
    let doubtful = doubtful(&alignment, script);
    let opinion = opinion.filter(|_| !is_corrected);
    let mismatches = opinion.map(|opinion| opinion.mismatches(script, &alignment));
    let grid = with_grid.then(|| grid::written(&alignment, script, &mouth.frames, (viseme_type, fps)));
    let mismatches = mismatches.unwrap_or(alignment.mismatches);
    let (codes, segment_starts) = (mouth.frames, mouth.segment_starts);
    let Alignment { words, phones, .. } = alignment;
    Heard { codes, segment_starts, words, phones, doubtful, mismatches, grid }
}

/// When the words of `text` are said, of which `script` was made.
pub(super) fn word_times(heard: &Heard, script: &Script, text: &str) -> WordTimes {
    let ms = |us: u64| u32::try_from(us / 1000).unwrap_or(u32::MAX);
    let mut times: Vec<WordTime> = Vec::new();
    // One that is not heard is doubtful, and takes no time.
    let said = heard.words.iter().zip(&script.words).filter(|(_, word)| !word.pronunciations.is_empty());
    for (aligned, word) in said {
        let is_doubtful = aligned.confidence < DOUBTFUL;
        match times.last_mut().filter(|last| last.range == word.range) {
            // A number is several words.
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

/// Where sound and `text` do not say the same, to be remembered: as times of words. Of what is not in the text, there are no
/// bytes; what is not said is doubtful.
pub(super) fn differences(heard: &Heard, script: &Script, text: &str) -> Option<WordTimes> {
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

/// The bytes of the text that a mismatch is about.
fn place(found: &Mismatch, script: &Script, text: &str) -> Range<usize> {
    let words = script.words.get(found.words.clone()).unwrap_or_default();
    match (words.first(), words.last()) {
        (Some(first), Some(last)) => first.range.start..last.range.end.max(first.range.start),
        // Between two words: where the next one starts.
        _ => {
            let at = script.words.get(found.words.start).map_or(text.len(), |next| next.range.start);
            at..at
        }
    }
}

/// Reports where sound and text do not say the same.
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
        (true, _) => {
            (format!("{} is not said: it should be {time}", written()), "remove it from the text, or record it")
        }
        (_, true) => {
            (format!("what is said {time} is not in the text"), "write it into the text, or cut it from the recording")
        }
        _ => (
            format!("{time}, something else is said than {}", written()),
            "listen there: is this the text of the recording? A word may also be said in another way (`{say: …}`, lexicon)",
        ),
    };
    Diagnostic::at(Code::TextMismatch, text.span_of(found.range.clone()), message).help(help)
}
