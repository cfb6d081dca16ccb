//! From sound and script to frames, and where somebody should listen.

use super::SyncOptions;
use lipz_compiler::{WordTime, WordTimes};
use lipz_diagnostics::{Code, Diagnostic, escape};
use lipz_file::JsonString;
use lipz_speech::{AlignedWord, Aligner, Alignment, Mismatch, MismatchKind, Model, Script, Sound, render, rms};
use lipz_types::{Fps, VisemeType};

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
    /// The words of the script of which nobody is sure: number and start in microseconds.
    pub(super) doubtful: Vec<(usize, u64)>,
    /// Where sound and script do not belong together.
    mismatches: Vec<Mismatch>,
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
}

/// The mouth of a sound.
pub(super) fn make(
    hearing: &Hearing<'_>,
    script: &Script,
    (viseme_type, fps): (VisemeType, Fps),
    options: &SyncOptions,
) -> Heard {
    let Hearing { sound, model, opinion } = *hearing;
    if viseme_type == VisemeType::Rms {
        let mouth = rms(sound, fps, &options.rms);
        return Heard { codes: mouth.frames, segment_starts: mouth.segment_starts, ..Heard::default() };
    }
    let aligner = Aligner::new(model, options.align);
    // Without words, whatever phones are heard.
    let alignment = if script.words.is_empty() { aligner.listen(sound) } else { aligner.align(sound, script) };
    let mouth = render(&alignment, viseme_type, fps, &options.rules);
    let doubtful = doubtful(&alignment, script);
    let mismatches = opinion.map(|opinion| opinion.mismatches(script, &alignment));
    let mismatches = mismatches.unwrap_or(alignment.mismatches);
    Heard { codes: mouth.frames, segment_starts: mouth.segment_starts, words: alignment.words, doubtful, mismatches }
}

/// When the words of `text` are said, of which `script` was made.
pub(super) fn word_times(heard: &Heard, script: &Script, text: &str) -> WordTimes {
    let ms = |us: u64| u32::try_from(us / 1000).unwrap_or(u32::MAX);
    let mut times: Vec<WordTime> = Vec::new();
    for (aligned, word) in heard.words.iter().zip(&script.words).filter(|(aligned, _)| aligned.pronunciation.is_some())
    {
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

/// Reports where sound and text do not say the same.
pub(super) fn mismatches(heard: &Heard, script: &Script, text: &JsonString<'_>) -> Vec<Diagnostic> {
    heard.mismatches.iter().map(|found| mismatch(found, script, text)).collect()
}

fn mismatch(found: &Mismatch, script: &Script, text: &JsonString<'_>) -> Diagnostic {
    let words = script.words.get(found.words.clone()).unwrap_or_default();
    let seconds = |us: u64| format!("{:.2} s", us as f64 / 1e6);
    let time = match found.end_us == found.start_us {
        true => format!("at {}", seconds(found.start_us)),
        false => format!("from {} to {}", seconds(found.start_us), seconds(found.end_us)),
    };
    let range = match (words.first(), words.last()) {
        (Some(first), Some(last)) => first.range.start..last.range.end.max(first.range.start),
        // Between two words: where the next one starts.
        _ => {
            let at = script.words.get(found.words.start).map_or(text.text.len(), |next| next.range.start);
            at..at
        }
    };
    let written = || escape::quoted(text.text.get(range.clone()).unwrap_or_default());
    let (message, help) = match found.kind {
        MismatchKind::NotSaid => {
            (format!("{} is not said: it should be {time}", written()), "remove it from the text, or record it")
        }
        MismatchKind::NotInScript => {
            (format!("what is said {time} is not in the text"), "write it into the text, or cut it from the recording")
        }
        _ => (
            format!("{time}, something else is said than {}", written()),
            "listen there: is this the text of the recording? A word may also be said in another way (`{say: …}`, lexicon)",
        ),
    };
    Diagnostic::at(Code::TextMismatch, text.span_of(range), message).help(help)
}
