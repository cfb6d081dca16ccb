//! The event strings of a clip's segments.

use super::texts::nul;
use lipz::diagnostic::show;
use lipz::event::{self, Command, EMOTIONS};
use lipz::{Code, Diagnostic, JsonString, text};

/// Unknown emotions that one element shows; nobody corrects more of them at a time.
const SHOWN: usize = 3;

/// The trimmed event string of each segment.
pub(super) fn trimmed<'t>(string: &'t JsonString<'_>, diagnostics: &mut Vec<Diagnostic>) -> Vec<&'t str> {
    nul(string, Code::NulInEvents, "the events contain", diagnostics);
    let mut unknown = 0;
    text::segments(&string.text)
        .map(|range| {
            let segment = &string.text[range.clone()];
            for event in event::parse(segment).unwrap_or_default() {
                if let Command::Feels(emotion) = event.command
                    && !EMOTIONS.contains(&emotion)
                {
                    unknown += 1;
                    if unknown <= SHOWN {
                        let word = range.start + event.last_word.start..range.start + event.last_word.end;
                        diagnostics.push(unknown_emotion(string, word, emotion));
                    }
                }
            }
            text::trim(segment)
        })
        .collect()
}

fn unknown_emotion(string: &JsonString<'_>, word: std::ops::Range<usize>, emotion: &str) -> Diagnostic {
    let headline = format!("{} is not an emotion of the specification", show::name(emotion));
    let finding = Diagnostic::at(Code::UnknownEmotion, string.span_of(word), headline)
        .note(format!("the emotions are {}", EMOTIONS.join(", ")));
    let near = EMOTIONS.iter().map(|known| (strsim::damerau_levenshtein(emotion, known), known)).min();
    match near.filter(|(distance, known)| emotion.len() < 40 && distance * 3 <= known.len()) {
        Some((_, known)) => finding.help(format!("did you mean `{known}`?")),
        None => finding.help("it is kept as written: make sure that your game knows it"),
    }
}
