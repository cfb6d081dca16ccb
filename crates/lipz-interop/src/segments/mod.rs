//! Segments of imported clips: where they start, and which part of the text belongs to each.

mod pauses;
mod sentences;

pub(crate) use pauses::{Place, Speech};

use crate::{Text, Time, Timed, Track};
use lipz_diagnostics::{Code, Diagnostic};
use lipz_file::text::{DELIMITER, trim};
use sentences::{cut, sentences, words};

/// Where an imported clip is divided into segments, if its text has no `|` that say so.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Segments {
    /// At the phrases of the file, if it has any.
    #[default]
    Phrases,
    /// Where the mouth rests for a while.
    Pauses,
    /// At the ends of the text's sentences.
    Sentences,
    /// Nowhere.
    None,
}

/// A clip's segments.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub(crate) struct Division {
    /// When each segment but the first starts.
    pub(crate) starts: Vec<Time>,
    /// The parts of each text, one for each segment.
    pub(crate) texts: Vec<Vec<String>>,
}

/// Divides the texts and the shapes of a track alike.
pub(crate) fn divide(
    track: &Track,
    speech: &Speech,
    texts: &[Text],
    segments: Segments,
    diagnostics: &mut Vec<Diagnostic>,
) -> Division {
    // `|` in a text say how many segments there are, whatever divides the others.
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

/// Whether `parts` say together what `text` says.
fn is_all(text: &str, parts: &[String]) -> bool {
    words(text).eq(parts.iter().flat_map(|part| words(part)))
}

/// The parts between the `|` of a text, trimmed.
fn parts(text: &str) -> Vec<String> {
    text.split(DELIMITER).map(|part| trim(part).to_owned()).collect()
}

/// A text in as many parts as there are segments.
fn parts_at(text: &str, starts: &[Time], track: &Track, speech: &Speech) -> Vec<String> {
    parts_by_words(text, starts, &track.words).unwrap_or_else(|| parts_by_shares(text, starts, speech))
}

/// A text in as many parts as there are segments, if it is known when each of its words is spoken.
pub(crate) fn parts_by_words(text: &str, starts: &[Time], spoken: &[Timed]) -> Option<Vec<String>> {
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

/// A text in as many parts as there are segments, as if every letter took the same time.
pub(crate) fn parts_by_shares(text: &str, starts: &[Time], speech: &Speech) -> Vec<String> {
    let shares: Vec<f64> = starts.iter().map(|start| speech.share(*start)).collect();
    cut(text, &shares)
}

/// When each of these parts but the first starts: as the file says, or else at the pause that is
/// nearest to where the part would start if every letter took the same time.
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
    diagnostics.extend(guessed(&places, "guessed as if every letter took the same time"));
    places.iter().map(|place| place.time).collect()
}

/// The diagnostic about the places that are guesses, if any is.
pub(crate) fn guessed(places: &[Place], note: &str) -> Option<Diagnostic> {
    let guessed = places.iter().filter(|place| place.is_guess).count();
    let (all, what) = (places.len(), if guessed == 1 { "boundaries is" } else { "boundaries are" });
    let message = format!("{guessed} of {all} segment {what} not in a pause of the mouth");
    let help = "move the `|` of the visemes to where the voice is, or divide the text at its pauses";
    (guessed > 0).then(|| Diagnostic::new(Code::SegmentGuessed, message).note(note).help(help))
}
