//! Character Event Syntax: what the events of a segment say (Lipz specification, last chapter).

use crate::text::{is_white_space, trim};
use std::ops::Range;

/// The emotions of the specification, table "Emotions".
pub const EMOTIONS: [&str; 11] =
    ["neutral", "amused", "happy", "sad", "irritated", "angry", "suspicious", "confused", "afraid", "thinking", "evil"];

/// One event: `[character] verb …`.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Event<'t> {
    /// Who; `None` for the speaker of the clip.
    pub character: Option<&'t str>,
    /// What.
    pub command: Command<'t>,
    /// Where the last word of the command stands, in bytes of the segment.
    pub last_word: Range<usize>,
}

/// What a character does.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Command<'t> {
    /// `feels emotion`: lasts until changed.
    Feels(&'t str),
    /// `sees target`: for a moment.
    Sees(&'t str),
    /// `stares target`: until `stops staring`.
    Stares(&'t str),
    /// `stops staring`.
    StopsStaring,
    /// `points target`: until `stops pointing`.
    Points(&'t str),
    /// `stops pointing`.
    StopsPointing,
    /// `does action`: an action of the game.
    Does(&'t str),
}

/// The events of a segment, separated by `,`; `None` if a part of it is some other syntax, as in
/// scripts: then the segment is one string that only the game understands.
///
/// An empty segment has no events.
///
/// ```
/// use lipz::event::{Command, parse};
/// let events = parse("feels sad, amy stops staring").ok_or("another syntax")?;
/// assert_eq!((events[0].character, events[0].command), (None, Command::Feels("sad")));
/// assert_eq!((events[1].character, events[1].command), (Some("amy"), Command::StopsStaring));
/// assert_eq!(parse("pointAt(butler, 3)"), None);
/// # Ok::<(), &str>(())
/// ```
pub fn parse(segment: &str) -> Option<Vec<Event<'_>>> {
    if trim(segment).is_empty() {
        return Some(Vec::new());
    }
    let mut start = 0;
    segment
        .split(',')
        .map(|part| {
            let event = event(part, start);
            start += part.len() + 1;
            event
        })
        .collect()
}

/// The event that `part` is; it starts at byte `start` of the segment.
fn event(part: &str, start: usize) -> Option<Event<'_>> {
    let words: Vec<&str> = part.split(is_white_space).filter(|word| !word.is_empty()).take(4).collect();
    let (character, command) = match words.as_slice() {
        [verb, object] => (None, command(verb, object)?),
        [character, verb, object] => (Some(*character), command(verb, object)?),
        _ => return None,
    };
    let end = part.trim_end_matches(is_white_space).len();
    let last = words.last()?.len();
    Some(Event { character, command, last_word: start + end - last..start + end })
}

fn command<'t>(verb: &str, object: &'t str) -> Option<Command<'t>> {
    Some(match (verb, object) {
        ("feels", emotion) => Command::Feels(emotion),
        ("sees", target) => Command::Sees(target),
        ("stares", target) => Command::Stares(target),
        ("points", target) => Command::Points(target),
        ("does", action) => Command::Does(action),
        ("stops", "staring") => Command::StopsStaring,
        ("stops", "pointing") => Command::StopsPointing,
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn one(segment: &str) -> Option<(Option<&str>, Command<'_>)> {
        match parse(segment)?.as_slice() {
            [event] => Some((event.character, event.command)),
            _ => None,
        }
    }

    #[test]
    fn every_verb_with_and_without_character() {
        let commands = [
            ("feels sad", Command::Feels("sad")),
            ("sees amy", Command::Sees("amy")),
            ("stares door", Command::Stares("door")),
            ("stops staring", Command::StopsStaring),
            ("points butler", Command::Points("butler")),
            ("stops pointing", Command::StopsPointing),
            ("does wave", Command::Does("wave")),
        ];
        for (text, command) in commands {
            assert_eq!(one(text), Some((None, command)));
            assert_eq!(one(&format!("  amy\t {text} ")), Some((Some("amy"), command)));
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
            "ringBell(3, \"low\")",
        ] {
            assert_eq!(parse(text), None, "{text}");
        }
        assert_eq!(parse(" \t"), Some(vec![]));
    }

    #[test]
    fn the_last_word_is_where_it_stands() {
        let text = " 日本 feels angry ,ü sees 海  ";
        let events = parse(text).unwrap();
        let words: Vec<&str> = events.iter().map(|event| &text[event.last_word.clone()]).collect();
        assert_eq!(words, ["angry", "海"]);
    }
}
