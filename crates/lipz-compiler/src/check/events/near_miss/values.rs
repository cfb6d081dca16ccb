//! Values that are wrong in events: decimal commas, `feels anger 2 and joy 3`, `nods four`.

use super::{EventFault, EventReading, NearMiss, is_nearly, whole};
use crate::check::events::names::{Role, RoleNames};
use lipz_file::emotion::NearBlend;
use lipz_file::event::{self, Word};
use lipz_file::text::is_white_space;

/// Forms of the verb before a blend of emotions.
const FEELS: [&str; 2] = ["feels", "feel"];

/// Forms of the verbs for gestures, which take an optional number, with their correct form.
const GESTURES: [(&str, &str); 8] = [
    ("nods", "nods"),
    ("nod", "nods"),
    ("shakes", "shakes"),
    ("shake", "shakes"),
    ("breathes", "breathes"),
    ("breathe", "breathes"),
    ("breath", "breathes"),
    ("breaths", "breathes"),
];
/// The verb for eyelids, with other forms.
const BLINKS: (&str, [&str; 2]) = ("blinks", ["blinks", "blink"]);
/// Numbers as words.
const NUMBERS: [&str; 11] = ["zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten"];
/// Words after a number of repetitions.
const TIMES: [&str; 2] = ["times", "time"];

/// The first decimal comma of a segment that would be Character Event Syntax with decimal points: `feels anger 2,5`.
pub(super) fn decimal_comma(segment: &str) -> Option<NearMiss<'_>> {
    let is_digit = |at: Option<usize>| at.and_then(|at| segment.as_bytes().get(at)).is_some_and(u8::is_ascii_digit);
    let is_decimal = |at: &usize| is_digit(at.checked_sub(1)) && is_digit(Some(at + 1));
    let commas: Vec<usize> = segment.match_indices(event::SEPARATOR).map(|(at, _)| at).filter(is_decimal).collect();
    let first = *commas.first()?;
    let mut next = commas.iter().peekable();
    let with_points: String =
        segment.char_indices().map(|(at, c)| if next.next_if_eq(&&at).is_some() { '.' } else { c }).collect();
    drop(event::parse(&with_points)?);
    let is_number = |c: char| c.is_ascii_digit();
    let start = segment[..first].trim_end_matches(is_number).len();
    let end = segment.len() - segment[first + 1..].trim_start_matches(is_number).len();
    let fault = EventFault::Value(with_points[start..end].to_owned());
    Some(NearMiss { at: start..end, event: start..end, fault })
}

/// Whether a word is a whole number, with an optional sign.
pub(super) fn is_number(word: &str) -> bool {
    let digits = word.trim_start_matches(['-', '+']);
    !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit())
}

impl<'t> EventReading<'t, '_> {
    /// Returns the fault if `words` are an optional character, `feels`, and nearly a blend of emotions.
    pub(super) fn blend(self, words: &[Word<'t>]) -> Option<NearMiss<'t>> {
        let verb = words.iter().take(2).find(|word| FEELS.contains(&word.text))?;
        let (start, end) = (verb.range().end - self.part.start, self.part.text.trim_end_matches(is_white_space).len());
        let names = RoleNames::new(Role::Emotion, self.known_names);
        let near = NearBlend::of(self.part.text.get(start..end)?, |name| names.contains(name))?;
        let character =
            words.first().filter(|first| *first != verb).map_or(String::new(), |who| format!("{} ", who.text));
        let behind = words.get(words.iter().position(|word| word == verb)? + 1)?.start;
        let at = if verb.text == FEELS[0] { behind } else { verb.start }..self.part.start + end;
        let fault = EventFault::Value(format!("{character}feels {}", near.meant));
        Some(NearMiss { at, event: whole(self.part), fault })
    }

    /// Returns the fault of a gesture with a different spelling, or with a word that should be a number.
    pub(super) fn gesture(self, words: &[Word<'t>]) -> Option<NearMiss<'t>> {
        let (verb, rest) = words.split_first()?;
        if rest.is_empty() && (BLINKS.1.contains(&verb.text)) {
            return Some(self.fault(verb.range(), EventFault::Verb, BLINKS.0, ""));
        }
        let (_, meant) = GESTURES.iter().find(|(other, _)| is_nearly(verb.text, other))?;
        let number = match rest {
            [] => {
                return GESTURES
                    .iter()
                    .any(|(other, _)| *other == verb.text)
                    .then(|| self.fault(verb.range(), EventFault::Verb, meant, ""));
            }
            [number] | [number, _] if rest.get(1).is_none_or(|times| TIMES.contains(&times.text)) => number,
            _ => return None,
        };
        let digits = number.text.trim_start_matches(['-', '+']);
        let word = NUMBERS.iter().position(|word| word.eq_ignore_ascii_case(digits)).map(|number| number.to_string());
        let number_meant = if is_number(digits) { Some(digits.to_owned()) } else { word }?;
        let is_verb = verb.text == *meant;
        let (start, fault): (_, fn(_, _) -> _) =
            if is_verb { (number.start, |_, meant| EventFault::Value(meant)) } else { (verb.start, EventFault::Verb) };
        let end = if is_verb { words.last()?.range().end } else { verb.range().end };
        Some(self.fault(start..end, fault, meant, &number_meant))
    }
}

#[cfg(test)]
mod tests {
    use super::super::near_misses;
    use super::*;
    use crate::project::KnownNames;

    /// The marked bytes of a segment, and the events that were probably meant.
    fn faults(segment: &str) -> Vec<(&str, String)> {
        let meant = |fault| match fault {
            EventFault::Verb(_, meant) | EventFault::Extra(_, meant) | EventFault::Value(meant) => meant,
            EventFault::Nothing => String::new(),
        };
        near_misses(segment, &KnownNames::default()).map(|miss| (&segment[miss.at], meant(miss.fault))).collect()
    }

    #[test]
    fn blends_and_gestures_that_are_spelled_otherwise() {
        let cases = [
            ("feels anger 2,5", "2,5", "2.5"),
            ("feels anger 3 over 0,4s, nods", "0,4", "0.4"),
            ("nods 4,5", "4,5", "4.5"),
            ("feels anger 2 and joy 3", "anger 2 and joy 3", "feels anger 2 + joy 3"),
            ("mara feels anger 2 joy 3 ", "anger 2 joy 3", "mara feels anger 2 + joy 3"),
            ("feel anger 2", "feel anger 2", "feels anger 2"),
            ("feels anger 3 over 2", "anger 3 over 2", "feels anger 3 over 2s"),
            ("feels anger 3 over .4s", "anger 3 over .4s", "feels anger 3 over 0.4s"),
            ("feels anger 3 over 0.2 s", "anger 3 over 0.2 s", "feels anger 3 over 0.2s"),
            ("feels anger 2.2345", "anger 2.2345", "feels anger 2.234"),
            ("nods -1", "-1", "nods 1"),
            ("mara nods four", "four", "mara nods 4"),
            ("nods 4 times", "4 times", "nods 4"),
            ("nod", "nod", "nods"),
            ("amy shake", "shake", "amy shakes"),
            ("blink", "blink", "blinks"),
            ("breathe", "breathe", "breathes"),
            ("breathe 6", "breathe", "breathes 6"),
            ("looks up", "looks up", "looks away"),
        ];
        for (segment, at, meant) in cases {
            assert_eq!(faults(segment), [(at, meant.to_owned())], "{segment}");
            assert!(event::parse(meant).is_some() || meant.parse::<f32>().is_ok(), "{meant}");
        }
    }

    #[test]
    fn other_syntax_is_left_alone() {
        for segment in [
            "say(2,5)",
            "2,5",
            "feels anger 2,5 jumps",
            "feels very anger 2",
            "nods twice",
            "nod, bow",
            "nods 4 5",
            "blink fast",
        ] {
            assert_eq!(faults(segment), [], "{segment}");
        }
    }
}
