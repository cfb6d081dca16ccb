//! Character Event Syntax: the events of a segment (Lipz specification, last chapter), and the gestures that lipz adds.

use crate::curve::thousandths;
use crate::emotion::Blend;
use crate::text::{is_white_space, trim};
pub use lipz_types::Command;
use std::fmt;
use std::ops::Range;

/// The separator of the events of a segment.
pub const SEPARATOR: char = ',';

/// The verb before a blend of emotions.
const FEELS: &str = "feels";

/// The verb that lipz adds, in addition to those that accept a number.
const BLINKS: &str = "blinks";
const LOOKS: &str = "looks";
const AWAY: &str = "away";

/// The emotions of the specification, table "Emotions".
pub const EMOTIONS: [&str; 11] =
    ["neutral", "amused", "happy", "sad", "irritated", "angry", "suspicious", "confused", "afraid", "thinking", "evil"];

/// A word of a segment, with its position.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Word<'t> {
    /// The word.
    pub text: &'t str,
    /// The offset in bytes of the segment.
    pub start: usize,
}

impl Word<'_> {
    /// Returns the position of the word, in bytes of the segment.
    pub fn range(&self) -> Range<usize> {
        self.start..self.start + self.text.len()
    }
}

/// One event: `[character] verb …`.
///
/// It is displayed as written, with one space between the words. The object of a [blend](crate::emotion) is its
/// strongest emotion.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Event<'t> {
    /// The character that acts; `None` for the speaker of the clip.
    pub character: Option<Word<'t>>,
    /// The action of the character.
    pub command: Command<Word<'t>, Word<'t>>,
    /// The position of the verb, in bytes of the segment; both words for `stops staring`.
    pub verb: Range<usize>,
}

/// Returns the command of these two words.
fn command<'t>(verb: &str, object: Word<'t>) -> Option<Command<Word<'t>, Word<'t>>> {
    Some(match (verb, object.text) {
        ("feels", _) => Command::Feels(object),
        ("sees", _) => Command::Sees(object),
        ("stares", _) => Command::Stares(object),
        ("points", _) => Command::Points(object),
        ("does", _) => Command::Does(object),
        ("stops", "staring") => Command::StopsStaring,
        ("stops", "pointing") => Command::StopsPointing,
        _ => return None,
    })
}

/// Parses words as a gesture. Returns it with the position of its verb.
fn gesture_command<'t>(words: &[Word<'t>]) -> Option<(Command<Word<'t>, Word<'t>>, Range<usize>)> {
    let is_number = |word: &Word<'_>| thousandths(word.text).is_ok_and(|number| number >= 0);
    let (verb, number) = match words {
        [verb] if verb.text == BLINKS => return Some((Command::Blinks, verb.range())),
        [verb, away] if (verb.text, away.text) == (LOOKS, AWAY) => {
            return Some((Command::LooksAway, verb.start..away.range().end));
        }
        [verb] => (verb, None),
        [verb, number] if is_number(number) => (verb, Some(*number)),
        _ => return None,
    };
    let command = match verb.text {
        "nods" => Command::Nods(number),
        "shakes" => Command::Shakes(number),
        "breathes" => Command::Breathes(number),
        _ => return None,
    };
    Some((command, verb.range()))
}

impl Event<'_> {
    /// Returns the number of a gesture in thousandths; `None` for events without a number.
    pub fn number(&self) -> Option<i32> {
        thousandths(self.command.amount()?.text).ok()
    }
}

impl fmt::Display for Event<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(character) = self.character {
            write!(f, "{} ", character.text)?;
        }
        f.write_str(self.command.verb())?;
        match self.command.object().or(self.command.amount()) {
            Some(word) => write!(f, " {}", word.text),
            None => Ok(()),
        }
    }
}

/// A part of a segment between two `,`: one event, or a different syntax.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Part<'t> {
    /// The part with the whitespace around it.
    pub text: &'t str,
    /// The offset in bytes of the segment.
    pub start: usize,
}

impl<'t> Part<'t> {
    /// Returns the words of the part.
    pub fn words(self) -> impl Iterator<Item = Word<'t>> {
        let mut at = 0;
        std::iter::from_fn(move || {
            let rest = self.text.get(at..)?.trim_start_matches(is_white_space);
            let start = self.text.len() - rest.len();
            let text = rest.split(is_white_space).next().filter(|word| !word.is_empty())?;
            at = start + text.len();
            Some(Word { text, start: self.start + start })
        })
    }

    /// Parses the part as an event; `None` if it has a different syntax.
    pub fn event(self) -> Option<Event<'t>> {
        self.short_event().or_else(|| self.feeling().map(|(event, _)| event)).or_else(|| self.gesture())
    }

    /// Parses the part as the event `[character] feels BLEND`, with its blend; `None` if it is something else.
    pub fn feeling(self) -> Option<(Event<'t>, Blend<'t>)> {
        let mut words = self.words();
        let (first, second) = (words.next()?, words.next()?);
        let (character, verb) = match (first.text, second.text) {
            (FEELS, _) => (None, first),
            (_, FEELS) => (Some(first), second),
            _ => return None,
        };
        let end = verb.range().end;
        let blend = Blend::parse(self.text.get(end - self.start..)?, end)?;
        let command = Command::Feels(blend.strongest()?);
        Some((Event { character, command, verb: verb.range() }, blend))
    }

    /// Parses an event that lipz adds: `[character] nods [number]`.
    fn gesture(self) -> Option<Event<'t>> {
        let words: Vec<Word<'t>> = self.words().take(4).collect();
        let of = |character, words: &[Word<'t>]| {
            let (command, verb) = gesture_command(words)?;
            Some(Event { character, command, verb })
        };
        of(None, &words).or_else(|| words.split_first().and_then(|(character, rest)| of(Some(*character), rest)))
    }

    /// Parses an event of the specification.
    fn short_event(self) -> Option<Event<'t>> {
        let mut words = self.words();
        let (first, second, third) = (words.next()?, words.next()?, words.next());
        let (character, verb, object) = match third {
            None => (None, first, second),
            Some(third) => (Some(first), second, third),
        };
        if words.next().is_some() {
            return None;
        }
        let command = command(verb.text, object)?;
        let end = if command.object().is_some() { verb } else { object }.range().end;
        Some(Event { character, command, verb: verb.start..end })
    }
}

/// Returns the parts of a segment between `,`. There is always at least one.
pub fn parts(segment: &str) -> impl Iterator<Item = Part<'_>> {
    let mut start = 0;
    segment.split(SEPARATOR).map(move |text| {
        let part = Part { text, start };
        start += text.len() + SEPARATOR.len_utf8();
        part
    })
}

/// Returns the events of a segment, separated by `,`. `None` if a part has a different syntax, as in scripts: the
/// segment is then one string, which only the game interprets.
///
/// An empty segment has no events.
///
/// ```
/// use lipz_file::event::parse;
/// let events: Vec<_> = parse("feels  sad, amy stops staring").ok_or("another syntax")?.collect();
/// assert_eq!((events[0].character, events[0].command.verb()), (None, "feels"));
/// assert_eq!(events[0].command.object().map(|word| (word.text, word.start)), Some(("sad", 7)));
/// assert_eq!(events[1].to_string(), "amy stops staring");
/// assert!(parse("pointAt(butler, 3)").is_none());
/// # Ok::<(), &str>(())
/// ```
pub fn parse(segment: &str) -> Option<impl Iterator<Item = Event<'_>>> {
    let is_event = |part: Part<'_>| part.event().is_some();
    let is_whole = trim(segment).is_empty() || parts(segment).all(is_event);
    is_whole.then(|| parts(segment).filter_map(Part::event))
}

/// Returns the events `[character] feels BLEND` of a segment, with their blends. Empty if a part has a different
/// syntax.
///
/// ```
/// use lipz_file::event::feelings;
/// assert_eq!(feelings("nods, mara feels fear 4").count(), 1);
/// assert_eq!(feelings("say('feels fear 4'), feels fear 4").count(), 0);
/// ```
pub fn feelings(segment: &str) -> impl Iterator<Item = (Event<'_>, Blend<'_>)> {
    // Most events have other verbs.
    let is_whole = segment.contains(FEELS) && parse(segment).is_some();
    parts(segment).filter(move |_| is_whole).filter_map(Part::feeling)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn all(segment: &str) -> Option<Vec<Event<'_>>> {
        parse(segment).map(Iterator::collect)
    }

    /// Returns character, verb and object of the only event in `segment`.
    fn one(segment: &str) -> Option<(Option<&str>, &str, Option<&str>)> {
        match all(segment)?.as_slice() {
            [event] => Some((
                event.character.map(|word| word.text),
                event.command.verb(),
                event.command.object().or(event.command.amount()).map(|word| word.text),
            )),
            _ => None,
        }
    }

    #[test]
    fn every_verb_with_and_without_character() {
        let commands = [
            ("feels sad", "feels", Some("sad")),
            ("sees amy", "sees", Some("amy")),
            ("stares door", "stares", Some("door")),
            ("stops staring", "stops staring", None),
            ("points butler", "points", Some("butler")),
            ("stops pointing", "stops pointing", None),
            ("does wave", "does", Some("wave")),
        ];
        for (text, verb, object) in commands {
            assert_eq!(one(text), Some((None, verb, object)));
            assert_eq!(one(&format!("  amy\t {text} ")), Some((Some("amy"), verb, object)));
        }
    }

    #[test]
    fn gestures_with_and_without_numbers() {
        let gestures = [
            ("nods", "nods", None),
            ("nods 4", "nods", Some("4")),
            ("shakes 2.5", "shakes", Some("2.5")),
            ("breathes 6", "breathes", Some("6")),
            ("blinks", "blinks", None),
            ("looks  away", "looks away", None),
        ];
        for (text, verb, number) in gestures {
            assert_eq!(one(text), Some((None, verb, number)));
            assert_eq!(one(&format!(" amy {text}")), Some((Some("amy"), verb, number)));
        }
        assert_eq!(all("nods 2.5").unwrap()[0].number(), Some(2500));
        // Syntax of the specification keeps its meaning.
        assert_eq!(one("nods feels sad"), Some((Some("nods"), "feels", Some("sad"))));
        assert_eq!(one("looks sees away"), Some((Some("looks"), "sees", Some("away"))));
        for text in ["nods -1", "nods twice", "nods 4 5", "blinks 2", "looks", "looks door", "amy bob nods"] {
            assert_eq!(all(text), None, "{text}");
        }
    }

    #[test]
    fn other_syntax_is_kept_whole() {
        for text in [
            "pointAt(butler)",
            "feels",
            "amy feels very sad",
            "stops crying",
            "feels sad,",
            "a,b",
            "Feels sad",
            "ringBell(3, \"low\")",
        ] {
            assert_eq!(all(text), None, "{text}");
        }
        assert_eq!(all(" \t"), Some(vec![]));
    }

    #[test]
    fn words_are_where_they_stand() {
        let text = " 日本 feels angry ,ü stops\t staring, sees 海  ";
        let events = all(text).unwrap();
        let at = |range: Range<usize>| &text[range];
        let verbs: Vec<&str> = events.iter().map(|event| at(event.verb.clone())).collect();
        assert_eq!(verbs, ["feels", "stops\t staring", "sees"]);
        let characters: Vec<&str> = events.iter().filter_map(|event| Some(at(event.character?.range()))).collect();
        assert_eq!(characters, ["日本", "ü"]);
        let objects: Vec<&str> = events.iter().filter_map(|event| Some(at(event.command.object()?.range()))).collect();
        assert_eq!(objects, ["angry", "海"]);
    }

    fn event() -> impl Strategy<Value = String> {
        let word = "[a-zé日-]{1,5}";
        let command = prop_oneof![
            ("feels|sees|stares|points|does", word).prop_map(|(verb, object)| format!("{verb} {object}")),
            "stops staring|stops pointing|nods|shakes [0-9]|breathes 1[.]5|blinks|looks away",
        ];
        (proptest::option::of(word), command).prop_map(|(character, command)| match character {
            Some(character) => format!("{character} {command}"),
            None => command,
        })
    }

    proptest! {
        /// Displaying and parsing events returns the same events.
        #[test]
        fn parse_and_display(events in proptest::collection::vec(event(), 1..4)) {
            let padded = events.join(" \t,\r\n ").replace(' ', "  ");
            let displayed: Vec<String> = parse(&padded).unwrap().map(|event| event.to_string()).collect();
            prop_assert_eq!(displayed, events);
        }
    }
}
