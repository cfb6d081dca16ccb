//! Segments of imported clips: their starts and their parts of the text.

mod pauses;
mod sentences;

pub(crate) use pauses::{PartStart, Speech};

use crate::{Text, Time, TimedText, Track};
use lipz_diagnostics::{Code, Diagnostic};
use lipz_file::text::{DELIMITER, trim};
use sentences::{cut, sentences, words};

/// The method of dividing an imported clip into segments, if its text has no `|`.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Segments {
    /// At the phrases of the file, if it has any.
    #[default]
    Phrases,
    /// Where the mouth rests for some time.
    Pauses,
    /// At the ends of the text's sentences.
    Sentences,
    /// The clip is not divided.
    None,
}

/// A clip's segments.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub(crate) struct Division {
    /// The start of each segment except the first.
    pub(crate) starts: Vec<Time>,
    /// The parts of each text, one for each segment.
    pub(crate) texts: Vec<Vec<String>>,
}

/// Divides the texts and the shapes of a track consistently.
pub(crate) fn divide(
    track: &Track,
    speech: &Speech,
    texts: &[Text],
    segments: Segments,
    diagnostics: &mut Vec<Diagnostic>,
) -> Division {
    // The `|` of a text determine the number of segments, whatever divides the others.
    if let Some(marked) = texts.iter().find(|text| text.text.contains(DELIMITER)) {
        let starts = starts_of(&parts(&marked.text), track, speech, diagnostics);
        let divided = |text: &Text| match parts(&text.text) {
            parts if parts.len() == starts.len() + 1 => parts,
            _ => parts_at(&text.text.replace(DELIMITER, " "), &starts, track, speech),
        };
        return Division { texts: texts.iter().map(divided).collect(), starts };
    }
    let by_times = |starts: Vec<Time>| {
        let texts = texts.iter().map(|text| parts_at(&text.text, &starts, track, speech)).collect();
        Division { starts, texts }
    };
    match (segments, texts.first()) {
        (Segments::Phrases, _) => {
            let starts = track.phrases.iter().skip(1).map(|phrase| phrase.start).collect();
            let of_file: Vec<String> = track.phrases.iter().map(|phrase| phrase.text.clone()).collect();
            match texts {
                [only] if track.phrases.len() > 1 && is_all(&only.text, &of_file) => {
                    Division { starts, texts: vec![of_file] }
                }
                _ => by_times(starts),
            }
        }
        (Segments::Pauses, _) => by_times(speech.pauses().map(|pause| pause.end).collect()),
        (Segments::Sentences, Some(first)) => {
            let parts = sentences(&first.text);
            let starts = starts_of(&parts, track, speech, diagnostics);
            let others = texts.iter().skip(1).map(|text| parts_at(&text.text, &starts, track, speech));
            Division { texts: std::iter::once(parts).chain(others.collect::<Vec<_>>()).collect(), starts }
        }
        (Segments::Sentences | Segments::None, _) => by_times(Vec::new()),
    }
}

/// Whether `parts` together have the words of `text`.
fn is_all(text: &str, parts: &[String]) -> bool {
    words(text).eq(parts.iter().flat_map(|part| words(part)))
}

/// Returns the parts between the `|` of a text, trimmed.
fn parts(text: &str) -> Vec<String> {
    text.split(DELIMITER).map(|part| trim(part).to_owned()).collect()
}

/// Splits a text into one part per segment.
fn parts_at(text: &str, starts: &[Time], track: &Track, speech: &Speech) -> Vec<String> {
    parts_by_words(text, starts, &track.words).unwrap_or_else(|| parts_by_shares(text, starts, speech))
}

/// Splits a text into one part per segment by the times of its words, if these are known.
pub(crate) fn parts_by_words(text: &str, starts: &[Time], spoken: &[TimedText]) -> Option<Vec<String>> {
    let words: Vec<usize> = words(text).map(|word| word.as_ptr() as usize - text.as_ptr() as usize).collect();
    if words.len() != spoken.len() {
        return None;
    }
    let mut rest = text;
    let mut parts: Vec<String> = starts
        .iter()
        .map(|start| {
            let first_word = spoken.partition_point(|word| word.start < *start);
            let end = words.get(first_word).copied().unwrap_or(text.len());
            let (part, after) = rest.split_at(end.saturating_sub(text.len() - rest.len()));
            rest = after;
            trim(part).to_owned()
        })
        .collect();
    parts.push(trim(rest).to_owned());
    Some(parts)
}

/// Splits a text into one part per segment, assuming that every letter takes the same time.
pub(crate) fn parts_by_shares(text: &str, starts: &[Time], speech: &Speech) -> Vec<String> {
    let shares: Vec<f64> = starts.iter().map(|start| speech.share(*start)).collect();
    cut(text, &shares)
}

/// Returns the starts of these parts except the first: those of the file, or else the pauses nearest to where the parts
/// would start if every letter took the same time.
fn starts_of(parts: &[String], track: &Track, speech: &Speech, diagnostics: &mut Vec<Diagnostic>) -> Vec<Time> {
    if track.phrases.len() == parts.len() {
        return track.phrases.iter().skip(1).map(|phrase| phrase.start).collect();
    }
    let counts: Vec<usize> = parts.iter().map(|part| words(part).count()).collect();
    if counts.iter().sum::<usize>() == track.words.len() {
        let mut before = 0;
        let mut first_words = counts.iter().map(|count| {
            before += count;
            track.words.get(before).map(|word| word.start)
        });
        let starts: Option<Vec<Time>> = first_words.by_ref().take(parts.len().saturating_sub(1)).collect();
        if let Some(starts) = starts {
            return starts;
        }
    }
    let lengths: Vec<usize> = parts.iter().map(|part| part.chars().filter(|c| c.is_alphanumeric()).count()).collect();
    let places = speech.starts(&lengths, Time::ZERO);
    diagnostics.extend(guessed(&places, "guessed with the same time for each letter"));
    places.iter().map(|place| place.time).collect()
}

/// Returns the diagnostic about guessed places, if there are any.
pub(crate) fn guessed(places: &[PartStart], note: &str) -> Option<Diagnostic> {
    let guessed = places.iter().filter(|place| place.is_guess).count();
    let (all, what) = (places.len(), if guessed == 1 { "boundaries is" } else { "boundaries are" });
    let message = format!("{guessed} of {all} segment {what} not in a pause of the mouth");
    let help = "move the `|` of the visemes to the pauses of the voice, or split the text at its pauses";
    (guessed > 0).then(|| Diagnostic::new(Code::SegmentGuessed, message).note(note).help(help))
}
