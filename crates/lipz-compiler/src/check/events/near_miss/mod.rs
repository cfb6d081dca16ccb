//! Segments that are nearly Character Event Syntax: a misspelt verb, an extra word, an extra `,`.
//!
//! Scripts and prose are legal, too. So a segment is reported only if it would be Character Event Syntax as a whole
//! once its faults are corrected. A misspelt verb counts only if the next word confirms it: a known emotion, target or
//! action.

mod values;

use super::names::{Role, RoleNames};
use crate::check::names::inside;
use crate::project::KnownNames;
use lipz_diagnostics::{Code, Diagnostic, Span, escape, suggest};
use lipz_file::event::{self, Part, Word};
use std::ops::Range;
use values::{decimal_comma, is_number};

/// Verbs with an object.
const VERBS: [&str; 5] = ["feels", "sees", "stares", "points", "does"];
/// The verb whose object is one of `STOPPED`.
const STOPS: &str = "stops";
const STOPPED: [&str; 2] = ["staring", "pointing"];
/// Different forms of `STOPPED`.
const STOPPED_OTHERWISE: [(&str, &str); 4] =
    [("stare", "staring"), ("stares", "staring"), ("point", "pointing"), ("points", "pointing")];

/// Forms of the verb in `looks away`, for eyes without a target.
const LOOKS: [&str; 2] = ["looks", "look"];
const AWAY: &str = "away";
/// Other directions, in which eyes cannot look without a target.
const DIRECTIONS: [&str; 5] = ["up", "down", "left", "right", "aside"];
/// Different spellings of verbs.
const OTHERWISE: [(&str, &str); 3] = [("do", "does"), ("look", "sees"), ("looks", "sees")];
/// English verbs that are one letter from a verb of the syntax, but do not mean it.
const NOT_MEANT: [&str; 23] = [
    "dies", "feeds", "goes", "painting", "paints", "prints", "scares", "scaring", "seeks", "seems", "sets", "sews",
    "shares", "sharing", "spares", "sparing", "starting", "starts", "starves", "starving", "states", "stores",
    "storing",
];
/// Words that English puts between verb and target, but the syntax does not.
const PREPOSITIONS: [&str; 2] = ["at", "to"];

/// The number of words in the longest part to check: `amy points at the butler`.
const MOST_WORDS: usize = 5;

/// The reason why a part is not an event.
pub(super) struct NearMiss<'t> {
    /// Its range, in bytes of the segment.
    pub(super) at: Range<usize>,
    /// The range that the suggested event replaces, in bytes of the segment.
    pub(super) event: Range<usize>,
    fault: EventFault<'t>,
}

enum EventFault<'t> {
    /// These words are not a verb, with the event that was probably meant.
    Verb(&'t str, String),
    /// These words are extra, with the event that was probably meant.
    Extra(&'t str, String),
    /// The value is not a blend of emotions or not the number of a gesture, with the event that was probably meant.
    Value(String),
    /// One side of this `,` is empty.
    Nothing,
}

/// Returns the faults of a segment that is not Character Event Syntax but was certainly meant to be.
pub(super) fn near_misses<'t>(segment: &'t str, known_names: &KnownNames) -> impl Iterator<Item = NearMiss<'t>> {
    let decimal_comma = decimal_comma(segment);
    let other = if decimal_comma.is_some() { "" } else { segment };
    decimal_comma.into_iter().chain(faults(other, known_names))
}

/// Returns the faults of a segment's parts.
fn faults<'t>(segment: &'t str, known_names: &KnownNames) -> impl Iterator<Item = NearMiss<'t>> {
    let fault = |part: Part<'t>| if part.event().is_some() { None } else { near_miss(part, known_names) };
    let mut has_event = false;
    let is_near_miss = event::parts(segment).all(|part| {
        let (is_event, fault) = (part.event().is_some(), fault(part));
        has_event |= is_event || fault.as_ref().is_some_and(|fault| !matches!(fault.fault, EventFault::Nothing));
        is_event || fault.is_some()
    });
    let faults = (is_near_miss && has_event).then(|| event::parts(segment).filter_map(fault));
    faults.into_iter().flatten()
}

/// Returns the fault of a part that is not an event.
fn near_miss<'t>(part: Part<'t>, known_names: &KnownNames) -> Option<NearMiss<'t>> {
    let words: Vec<Word<'t>> = part.words().take(MOST_WORDS + 1).collect();
    if words.is_empty() {
        let separator = part.start.checked_sub(1).unwrap_or(part.text.len());
        let at = separator..separator + 1;
        return Some(NearMiss { event: at.clone(), at, fault: EventFault::Nothing });
    }
    // The verb is the first word, or the second if a character comes first.
    let speaker = EventReading { part, character: None, known_names };
    if let Some(blend) = speaker.blend(&words) {
        return Some(blend);
    }
    if words.len() > MOST_WORDS || !words.iter().all(|word| is_plain(word.text) || is_number(word.text)) {
        return None;
    }
    speaker.near(&words).or_else(|| {
        let (character, rest) = words.split_first()?;
        EventReading { character: Some(*character), ..speaker }.near(rest)
    })
}

/// Whether a word can be a name or a verb, and is not part of a script or the end of a sentence.
fn is_plain(word: &str) -> bool {
    word.starts_with(char::is_alphanumeric) && word.chars().all(|c| c.is_alphanumeric() || "-_'’".contains(c))
}

/// A part as an event of a character.
#[derive(Clone, Copy)]
struct EventReading<'t, 'r> {
    part: Part<'t>,
    character: Option<Word<'t>>,
    known_names: &'r KnownNames,
}

impl<'t> EventReading<'t, '_> {
    /// Returns the fault if `words` are nearly a verb with its object.
    fn near(self, words: &[Word<'t>]) -> Option<NearMiss<'t>> {
        if let Some(gesture) = self.gesture(words) {
            return Some(gesture);
        }
        match words {
            [verb, object] if is_nearly(verb.text, STOPS) => self.stops(*verb, *object),
            [verb, away] if is_nearly(away.text, AWAY) && LOOKS.iter().any(|looks| is_nearly(verb.text, looks)) => {
                Some(self.fault(verb.start..away.range().end, EventFault::Verb, "looks", AWAY))
            }
            [verb, direction] if DIRECTIONS.contains(&direction.text) && LOOKS.contains(&verb.text) => {
                Some(self.fault(verb.start..direction.range().end, EventFault::Verb, LOOKS[0], AWAY))
            }
            [verb, object] => self.misspelt(*verb, *object),
            [verb, between @ .., object] => self.too_many_words(*verb, between, *object),
            _ => None,
        }
    }

    /// `stop staring`, `stops stare`
    fn stops(self, written: Word<'t>, object: Word<'t>) -> Option<NearMiss<'t>> {
        let otherwise = STOPPED_OTHERWISE.iter().find(|(other, _)| other.eq_ignore_ascii_case(object.text));
        let otherwise = otherwise.map(|(_, stopped)| *stopped);
        let stopped = otherwise.or_else(|| STOPPED.into_iter().find(|stopped| is_nearly(object.text, stopped)))?;
        Some(self.fault(written.start..object.range().end, EventFault::Verb, STOPS, stopped))
    }

    /// `feel sad`
    fn misspelt(self, written: Word<'t>, object: Word<'t>) -> Option<NearMiss<'t>> {
        let verb = verb(written.text)?;
        let names = RoleNames::new(Role::of_object(verb)?, self.known_names);
        let is_certain = written.text.eq_ignore_ascii_case(verb) || names.contains(object.text);
        let object = if is_certain { object.text } else { names.nearest(object.text)? };
        Some(self.fault(written.range(), EventFault::Verb, verb, object))
    }

    /// `points at door`, `feels very sad`
    fn too_many_words(self, written: Word<'t>, between: &[Word<'t>], object: Word<'t>) -> Option<NearMiss<'t>> {
        let (first, last) = (between.first()?, between.last()?);
        let verb = verb(written.text)?;
        let is_verb = written.text == verb;
        let is_known = RoleNames::new(Role::of_object(verb)?, self.known_names).contains(object.text);
        // If no known name confirms the verb, only a phrase that cannot describe a character counts: `points at door`.
        let is_english = is_verb && between.len() == 1 && PREPOSITIONS.contains(&first.text);
        let is_certain = is_known || (is_english && self.character.is_none());
        let (start, fault): (_, fn(_, _) -> _) =
            if is_verb { (first.start, EventFault::Extra) } else { (written.start, EventFault::Verb) };
        is_certain.then(|| self.fault(start..last.range().end, fault, verb, object.text))
    }

    fn fault(
        self,
        at: Range<usize>,
        fault: fn(&'t str, String) -> EventFault<'t>,
        verb: &str,
        object: &str,
    ) -> NearMiss<'t> {
        let words = &self.part.text[at.start - self.part.start..at.end - self.part.start];
        let words_meant = self.character.map(|who| who.text).into_iter().chain([verb, object]);
        let meant = words_meant.filter(|word| !word.is_empty()).collect::<Vec<_>>().join(" ");
        NearMiss { at, event: whole(self.part), fault: fault(words, meant) }
    }
}

/// Returns the range of a part in its segment, without the white space around it.
fn whole(part: Part<'_>) -> Range<usize> {
    let (first, last) = (part.words().next(), part.words().last());
    first.zip(last).map_or(part.start..part.start, |(first, last)| first.start..last.range().end)
}

/// Returns the verb with an object that a word is or probably means.
fn verb(word: &str) -> Option<&'static str> {
    match OTHERWISE.iter().find(|(written, _)| word.eq_ignore_ascii_case(written)) {
        Some((_, verb)) => Some(verb),
        None => VERBS.into_iter().find(|verb| is_nearly(word, verb)),
    }
}

/// Whether a word differs from the verb only in case and at most one letter.
fn is_nearly(word: &str, verb: &str) -> bool {
    let is_meant = || !NOT_MEANT.iter().any(|other| word.eq_ignore_ascii_case(other));
    suggest::distance(word, verb).is_some_and(|distance| distance <= 1) && is_meant()
}

impl NearMiss<'_> {
    /// The diagnostic, with the places of the fault and of the event.
    pub(super) fn diagnostic(&self, span: Span, event: Span) -> Diagnostic {
        let did_you_mean = |meant: &str| format!("did you mean {}?", escape::quoted(meant));
        let (message, help) = match &self.fault {
            EventFault::Verb(words, meant) => {
                (format!("{} is not a verb of Character Event Syntax", escape::quoted(words)), did_you_mean(meant))
            }
            EventFault::Extra(words, meant) => {
                (format!("{} is between a verb and its object", escape::quoted(words)), did_you_mean(meant))
            }
            EventFault::Value(meant) => ("this value is not allowed in an event".to_owned(), did_you_mean(meant)),
            EventFault::Nothing => ("an event is missing next to this `,`".to_owned(), "remove the `,`".to_owned()),
        };
        let found = Diagnostic::at(Code::NearEvent, span, message)
            .note("the whole segment is kept as text; games do not see its events")
            .help(help);
        match &self.fault {
            EventFault::Verb(_, meant) | EventFault::Extra(_, meant) | EventFault::Value(meant) => {
                found.suggest(event, inside(meant))
            }
            EventFault::Nothing => found.suggest(event, ""),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    fn known_names() -> KnownNames {
        let names = |names: &str| Some(names.split(' ').map(str::to_owned).collect::<BTreeSet<_>>());
        KnownNames {
            characters: names("amy rob"),
            props: names("door lamp"),
            actions: names("wave"),
            ..KnownNames::default()
        }
    }

    /// The marked bytes of a segment, and the events that were probably meant.
    fn faults<'t>(segment: &'t str, known_names: &KnownNames) -> Vec<(&'t str, String)> {
        let meant = |fault| match fault {
            EventFault::Verb(_, meant) | EventFault::Extra(_, meant) | EventFault::Value(meant) => meant,
            EventFault::Nothing => String::new(),
        };
        near_misses(segment, known_names).map(|miss| (&segment[miss.at], meant(miss.fault))).collect()
    }

    #[test]
    fn what_is_nearly_an_event() {
        let cases = [
            ("feel sad", "feel", "feels sad"),
            ("amy  feals happy ", "feals", "amy feels happy"),
            ("feals hapy", "feals", "feels happy"),
            ("Feels  jealous", "Feels", "feels jealous"),
            ("amy Sees mayor", "Sees", "amy sees mayor"),
            ("stop staring", "stop staring", "stops staring"),
            ("stops stare", "stops stare", "stops staring"),
            ("amy stops points", "stops points", "amy stops pointing"),
            ("amy stops pionting", "stops pionting", "amy stops pointing"),
            ("feels very sad", "very", "feels sad"),
            ("points at butler", "at", "points butler"),
            ("nodds 4", "nodds", "nods 4"),
            ("amy shake 2", "shake", "amy shakes 2"),
            ("breath 6", "breath", "breathes 6"),
            ("look away", "look away", "looks away"),
        ];
        let with_names = [
            ("stare door", "stare", "stares door"),
            ("amy pionts lampe", "pionts", "amy points lamp"),
            ("do wave", "do", "does wave"),
            ("amy looks at rob", "looks at", "amy sees rob"),
            ("amy points at the door", "at the", "amy points door"),
        ];
        for (segment, at, meant) in cases {
            assert_eq!(faults(segment, &KnownNames::default()), [(at, meant.to_owned())], "{segment}");
        }
        for (segment, at, meant) in cases.into_iter().chain(with_names) {
            assert_eq!(faults(segment, &known_names()), [(at, meant.to_owned())], "{segment}");
        }
    }

    #[test]
    fn what_some_other_syntax_is_left_to() {
        let segments = [
            "pointAt(butler)",
            "feel(sad)",
            "feel sad()",
            "if feel == sad then",
            "-- feel sad",
            "say(\"amy feel sad, rob feel happy\")",
            "feels sad, playSound(3)",
            "feel sad, ring bell",
            "amy feeds rob",
            "amy scares rob",
            "amy goes wave",
            "stops sharing",
            "stops crying",
            "we feel fine",
            "She points at him",
            "They see the light.",
            "Points at the door.",
            "nod, bow",
            "bow, look-at mayor",
            ",",
            "a,",
            "",
        ];
        for segment in segments {
            assert_eq!(faults(segment, &KnownNames::default()), [], "{segment}");
            assert_eq!(faults(segment, &known_names()), [], "{segment}");
        }
    }

    #[test]
    fn one_part_of_several() {
        let fault = |at, meant: &str| (at, meant.to_owned());
        let of = |segment| faults(segment, &KnownNames::default());
        assert_eq!(of("feels sad, amy feel happy"), [fault("feel", "amy feels happy")]);
        assert_eq!(of("feel sad,Feels happy"), [fault("feel", "feels sad"), fault("Feels", "feels happy")]);
        assert_eq!(of("feels sad, "), [fault(",", "")]);
        assert_eq!(of(",feels sad"), [fault(",", "")]);
        assert_eq!(of("日本 feels sad,,stops staring"), [fault(",", "")]);
    }

    /// Each word of the list would be taken for a verb without it.
    #[test]
    fn other_verbs_are_near() {
        for word in NOT_MEANT {
            let all = VERBS.iter().chain(&STOPPED);
            let nearest = all.filter_map(|verb| suggest::distance(word, verb)).min();
            assert_eq!((nearest, verb(word)), (Some(1), None), "{word}");
        }
    }
}
