//! From sound and script to frames, and which words of the script somebody should listen to.

use super::SyncOptions;
use lipz_diagnostics::{Code, Diagnostic, escape};
use lipz_file::JsonString;
use lipz_speech::{Aligner, Alignment, Model, Script, Sound, render, rms};
use lipz_types::{Fps, VisemeType};

/// Doubtful words that a diagnostic marks.
const MARKED: usize = 5;

/// What was heard.
pub(super) struct Heard {
    /// The codes of the frames.
    pub(super) codes: String,
    /// The first frame of each segment.
    pub(super) segment_starts: Vec<usize>,
    /// The words of the script of which nobody is sure: number and start in microseconds.
    pub(super) doubtful: Vec<(usize, u64)>,
}

/// The mouth of a sound.
pub(super) fn make(sound: &Sound, script: &Script, viseme_type: VisemeType, fps: Fps, options: &SyncOptions) -> Heard {
    if viseme_type == VisemeType::Rms {
        let mouth = rms(sound, fps, &options.rms);
        return Heard { codes: mouth.frames, segment_starts: mouth.segment_starts, doubtful: Vec::new() };
    }
    if script.words.is_empty() {
        return by_loudness(sound, viseme_type, fps, options);
    }
    let aligner = Aligner::new(Model::english(), options.align);
    let alignment = aligner.align(sound, script);
    let mouth = render(&alignment, viseme_type, fps, &options.rules);
    Heard { codes: mouth.frames, segment_starts: mouth.segment_starts, doubtful: doubtful_words(&alignment, script) }
}

/// The mouth of a voice whose words nobody knows: as far open as the voice is loud.
fn by_loudness(sound: &Sound, viseme_type: VisemeType, fps: Fps, options: &SyncOptions) -> Heard {
    let mouth = rms(sound, fps, &options.rms);
    let open = |digit: char| match (digit, viseme_type) {
        ('0'..='2', VisemeType::Blair) => 'S',
        ('3'..='5', VisemeType::Blair) => 'E',
        ('6'..='9', VisemeType::Blair) => 'A',
        ('0'..='2', VisemeType::ToonBoom) => 'B',
        ('3'..='5', VisemeType::ToonBoom) => 'C',
        ('6'..='9', VisemeType::ToonBoom) => 'D',
        (code, _) => code,
    };
    Heard {
        codes: mouth.frames.chars().map(open).collect(),
        segment_starts: mouth.segment_starts,
        doubtful: Vec::new(),
    }
}

fn doubtful_words(alignment: &Alignment, script: &Script) -> Vec<(usize, u64)> {
    let words = alignment.words.iter().zip(&script.words).enumerate();
    let is_said = words.filter(|(_, (_, word))| !word.pronunciations.is_empty());
    let doubtful = is_said.filter(|(_, (word, _))| word.pronunciation.is_none());
    doubtful.map(|(number, (word, _))| (number, word.start_us)).collect()
}

/// Reports the doubtful words of a text.
pub(super) fn doubtful(heard: &Heard, script: &Script, text: &JsonString<'_>) -> Option<Diagnostic> {
    let words: Vec<_> =
        heard.doubtful.iter().filter_map(|(number, us)| Some((script.words.get(*number)?, *us))).collect();
    let ((first, first_us), others) = words.split_first()?;
    let said = script.words.iter().filter(|word| !word.pronunciations.is_empty()).count();
    let at = |us: u64| format!("{:.2} s", us as f64 / 1e6);
    let message = match words.len() {
        1 => format!("it is not sure that {} is said at {}", escape::quoted(&first.text), at(*first_us)),
        count if count * 2 > said => {
            format!("most words ({count} of {said}) are not heard: is this the text of the recording?")
        }
        count => format!("it is not sure that {count} of {said} words are said where they are looked for"),
    };
    let mut diagnostic = Diagnostic::at(Code::DoubtfulWords, text.span_of(first.range.clone()), message);
    for (word, us) in others.iter().take(MARKED) {
        diagnostic = diagnostic.also(text.span_of(word.range.clone()), at(*us));
    }
    Some(
        diagnostic.help("listen there: the text may be another, or the word said in another way (`{say: …}`, lexicon)"),
    )
}
