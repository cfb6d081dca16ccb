//! Segments that are nearly Character Event Syntax: a verb misspelt, a word too many, a `,` too many.
//!
//! Scripts and prose are legal, too. So a segment is reported only if it would be Character Event
//! Syntax as a whole once its faults are corrected, and a misspelt verb is believed only where what
//! follows confirms it: a known emotion, target or action.

use super::names::{Names, Role};
use crate::Registry;
use lipz::diagnostic::{show, suggest};
use lipz::event::{self, Part, Word};
use lipz::{Code, Diagnostic, Span};
use std::ops::Range;

/// Verbs that an object follows.
const VERBS: [&str; 5] = ["feels", "sees", "stares", "points", "does"];
/// The verb of which the object is one of the next.
const STOPS: &str = "stops";
const STOPPED: [&str; 2] = ["staring", "pointing"];

/// Words that stand for verbs although they are spelled otherwise.
const OTHERWISE: [(&str, &str); 3] = [("do", "does"), ("look", "sees"), ("looks", "sees")];
/// English verbs that are one letter from a verb of the syntax, and not meant for it.
const NOT_MEANT: [&str; 23] = [
    "dies", "feeds", "goes", "painting", "paints", "prints", "scares", "scaring", "seeks", "seems", "sets", "sews",
    "shares", "sharing", "spares", "sparing", "starting", "starts", "starves", "starving", "states", "stores",
    "storing",
];
/// Words that English has between verb and target, where the syntax has none.
const PREPOSITIONS: [&str; 2] = ["at", "to"];

/// Words of the longest part that is looked at: `amy points at the butler`.
const MOST_WORDS: usize = 5;

/// What keeps a part from being an event.
pub(super) struct Near<'t> {
    /// Where it stands, in bytes of the segment.
    pub(super) at: Range<usize>,
    slip: Slip<'t>,
    /// The event that was probably meant.
    meant: String,
}

enum Slip<'t> {
    /// These words are no verb.
    Verb(&'t str),
    /// These words are too many.
    Extra(&'t str),
    /// Nothing stands beside this `,`.
    Nothing,
}

/// The faults of a segment that is not Character Event Syntax, if it certainly was to be.
pub(super) fn near<'t>(segment: &'t str, registry: &Registry) -> Vec<Near<'t>> {
    let mut faults = Vec::new();
    let mut has_event = false;
    for part in event::parts(segment) {
        if part.event().is_some() {
            has_event = true;
            continue;
        }
        match near_part(part, registry) {
            Some(fault) => {
                has_event |= !matches!(fault.slip, Slip::Nothing);
                faults.push(fault);
            }
            None => return Vec::new(),
        }
    }
    if has_event { faults } else { Vec::new() }
}

/// The fault of a part that is no event.
fn near_part<'t>(part: Part<'t>, registry: &Registry) -> Option<Near<'t>> {
    let words: Vec<Word<'t>> = part.words().take(MOST_WORDS + 1).collect();
    if words.is_empty() {
        let separator = part.start.checked_sub(1).unwrap_or(part.text.len());
        return Some(Near { at: separator..separator + 1, slip: Slip::Nothing, meant: String::new() });
    }
    if words.len() > MOST_WORDS || !words.iter().all(|word| is_plain(word.text)) {
        return None;
    }
    near_command(part, None, &words, registry).or_else(|| {
        let (character, rest) = words.split_first()?;
        near_command(part, Some(*character), rest, registry)
    })
}

/// Whether a word is a name or a verb, rather than part of a script or the end of a sentence.
fn is_plain(word: &str) -> bool {
    word.starts_with(char::is_alphanumeric) && word.chars().all(|c| c.is_alphanumeric() || "-_'’".contains(c))
}

/// The fault of an event of which `words` are the verb and what follows.
fn near_command<'t>(
    part: Part<'t>,
    character: Option<Word<'t>>,
    words: &[Word<'t>],
    registry: &Registry,
) -> Option<Near<'t>> {
    let [written, between @ .., object] = words else { return None };
    let (at, slip, command): (_, fn(&'t str) -> Slip<'t>, _) = match between {
        [] if is_nearly(written.text, STOPS) => {
            let stopped = STOPPED.into_iter().find(|stopped| is_nearly(object.text, stopped))?;
            (written.start..object.range().end, Slip::Verb, format!("{STOPS} {stopped}"))
        }
        [] => {
            let verb = verb(written.text)?;
            let names = Names::of(Role::of_object(verb)?, registry);
            let is_verb_but_for_case = written.text.eq_ignore_ascii_case(verb);
            let is_certain = is_verb_but_for_case || names.contains(object.text);
            let object = if is_certain { object.text } else { names.nearest(object.text)? };
            (written.range(), Slip::Verb, format!("{verb} {object}"))
        }
        [first, .., last] | [first @ last] => {
            let verb = verb(written.text)?;
            let is_known = Names::of(Role::of_object(verb)?, registry).contains(object.text);
            let is_english = written.text == verb && between.len() == 1 && PREPOSITIONS.contains(&first.text);
            let is_certain = is_known || is_english && character.is_none();
            if !is_certain {
                return None;
            }
            let meant = format!("{verb} {}", object.text);
            if written.text == verb {
                (first.start..last.range().end, Slip::Extra, meant)
            } else {
                (written.start..last.range().end, Slip::Verb, meant)
            }
        }
    };
    let slip = slip(&part.text[at.start - part.start..at.end - part.start]);
    let meant = character.map_or_else(|| command.clone(), |character| format!("{} {command}", character.text));
    Some(Near { at, slip, meant })
}

/// The verb with an object that a word is, or that was meant by it.
fn verb(word: &str) -> Option<&'static str> {
    match OTHERWISE.iter().find(|(written, _)| word.eq_ignore_ascii_case(written)) {
        Some((_, verb)) => Some(verb),
        None => VERBS.into_iter().find(|verb| is_nearly(word, verb)),
    }
}

/// Whether a word is the verb, but for case and one letter.
fn is_nearly(word: &str, verb: &str) -> bool {
    let is_meant = || !NOT_MEANT.iter().any(|other| word.eq_ignore_ascii_case(other));
    suggest::distance(word, verb).is_some_and(|distance| distance <= 1) && is_meant()
}

impl Near<'_> {
    pub(super) fn finding(&self, span: Span) -> Diagnostic {
        let (headline, help) = match &self.slip {
            Slip::Verb(words) => (format!("{} is not a verb of Character Event Syntax", show::name(words)), None),
            Slip::Extra(word) => (format!("{} stands between a verb and its object", show::name(word)), None),
            Slip::Nothing => ("an event is missing beside this `,`".to_owned(), Some("remove the `,`".to_owned())),
        };
        Diagnostic::at(Code::NearEvent, span, headline)
            .note("all of the segment is kept as text: games see no events in it")
            .help(help.unwrap_or_else(|| format!("did you mean {}?", show::name(&self.meant))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    fn registry() -> Registry {
        let names = |names: &str| Some(names.split(' ').map(str::to_owned).collect::<BTreeSet<_>>());
        Registry {
            characters: names("amy rob"),
            props: names("door lamp"),
            actions: names("wave"),
            ..Registry::default()
        }
    }

    /// What is marked in a segment, and what was meant by it.
    fn faults<'t>(segment: &'t str, registry: &Registry) -> Vec<(&'t str, String)> {
        near(segment, registry).into_iter().map(|near| (&segment[near.at], near.meant)).collect()
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
            ("amy stops pionting", "stops pionting", "amy stops pointing"),
            ("feels very sad", "very", "feels sad"),
            ("points at butler", "at", "points butler"),
        ];
        let with_names = [
            ("stare door", "stare", "stares door"),
            ("amy pionts lampe", "pionts", "amy points lamp"),
            ("do wave", "do", "does wave"),
            ("amy looks at rob", "looks at", "amy sees rob"),
            ("amy points at the door", "at the", "amy points door"),
        ];
        for (segment, at, meant) in cases {
            assert_eq!(faults(segment, &Registry::default()), [(at, meant.to_owned())], "{segment}");
        }
        for (segment, at, meant) in cases.into_iter().chain(with_names) {
            assert_eq!(faults(segment, &registry()), [(at, meant.to_owned())], "{segment}");
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
            "nod",
            "bow, look-at mayor",
            ",",
            "a,",
            "",
        ];
        for segment in segments {
            assert_eq!(faults(segment, &Registry::default()), [], "{segment}");
            assert_eq!(faults(segment, &registry()), [], "{segment}");
        }
    }

    #[test]
    fn one_part_of_several() {
        let fault = |at, meant: &str| (at, meant.to_owned());
        let of = |segment| faults(segment, &Registry::default());
        assert_eq!(of("feels sad, amy feel happy"), [fault("feel", "amy feels happy")]);
        assert_eq!(of("feel sad,Feels happy"), [fault("feel", "feels sad"), fault("Feels", "feels happy")]);
        assert_eq!(of("feels sad, "), [fault(",", "")]);
        assert_eq!(of(",feels sad"), [fault(",", "")]);
        assert_eq!(of("日本 feels sad,,stops staring"), [fault(",", "")]);
    }

    /// No word stands in the list that would not be taken for a verb without it.
    #[test]
    fn other_verbs_are_near() {
        for word in NOT_MEANT {
            let all = VERBS.iter().chain(&STOPPED);
            let nearest = all.filter_map(|verb| suggest::distance(word, verb)).min();
            assert_eq!((nearest, verb(word)), (Some(1), None), "{word}");
        }
    }
}
