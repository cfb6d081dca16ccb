//! The gestures of events: `nods 4`, `mara looks away`.

use super::shapes::Kind;
use super::{Gesture, MOST};
use crate::clip::ClipData;
use crate::options::Gestures;
use lipz_bank::curve::CurveValue;
use lipz_diagnostics::{Code, Diagnostic, Span, escape};
use lipz_file::event::{self, Command, Event};
use lipz_file::{JsonString, text};

/// How far eyes look away, in thousandths of a degree: they go beyond the 20 degrees after which the head follows.
const AWAY: i32 = 25_000;
/// How far lids close, in thousandths.
const CLOSED: i32 = 1000;

/// The gestures of a clip's events, and where the events are.
pub(super) fn of_events<'e>(
    events: &'e JsonString<'_>,
    clip: &ClipData,
    own: &Gestures,
    diagnostics: &mut Vec<Diagnostic>,
) -> Vec<(Gesture<'e>, Span)> {
    let mut found = Vec::new();
    for (segment, range) in text::segments(&events.text).enumerate() {
        for event in event::parse(&events.text[range.clone()]).into_iter().flatten() {
            let Some((kind, usual)) = kind_of(&event, own) else { continue };
            let end = event.command.amount().map_or(event.verb.end, |number| number.range().end);
            let span = events.span_of(range.start + event.verb.start..range.start + end);
            let strength = event.number().unwrap_or(usual);
            if event.number().is_some_and(|number| number > MOST) {
                diagnostics.push(too_high(&event, strength, span));
            }
            let who = event.character.map(|word| word.text);
            let gesture = Gesture::new(kind, clip.segment_start(segment), strength.min(MOST.max(usual)));
            found.push((Gesture { who, ..gesture }, span));
        }
    }
    found
}

/// Whether events of a segment become curves.
pub(in crate::check) fn are_in_events(segment: &str) -> bool {
    let own = Gestures::default();
    event::parse(segment).into_iter().flatten().any(|event| kind_of(&event, &own).is_some())
}

/// The gesture of an event, and how far it goes without a number.
fn kind_of(event: &Event<'_>, own: &Gestures) -> Option<(Kind, i32)> {
    match event.command {
        Command::Nods(_) => Some((Kind::Nod, own.nods_thousandths)),
        Command::Shakes(_) => Some((Kind::Shake, own.nods_thousandths)),
        Command::Breathes(_) => Some((Kind::Breath, own.breath_thousandths)),
        Command::Blinks => Some((Kind::Blink, CLOSED)),
        Command::LooksAway => Some((Kind::LookAway, AWAY)),
        _ => None,
    }
}

fn too_high(event: &Event<'_>, strength: i32, span: Span) -> Diagnostic {
    let value = CurveValue::from_thousandths(strength);
    let message = format!("{} {value} is outside of 0 to 10", event.command.verb());
    Diagnostic::at(Code::GestureValue, span, message)
        .note("the curve gets the gesture with 10")
        .help("write a number from 0, nothing, to 10, the most that a face can do")
}

/// The diagnostic for the first gesture of a clip without a frame rate.
pub(super) fn without_fps((_, span): &(Gesture<'_>, Span)) -> Diagnostic {
    Diagnostic::at(Code::GestureHidden, *span, "the gesture moves nothing: the clip has no frame rate")
        .note("a gesture takes a time, of which lipz has to make frames")
        .help("add `fps` to the file, or `default-fps` to lipz.toml for all that have none")
}

/// The diagnostic for the gesture of an event that moves no curve: those of the file are still, or it has no place on them.
pub(super) fn hidden(gesture: &Gesture<'_>, span: Span, is_still: bool, clip: &ClipData) -> Diagnostic {
    let (message, help) = match is_still {
        true => {
            let name = gesture.kind.paths().first().map_or(String::new(), |(curve, _)| gesture.name_of(*curve));
            let quoted = escape::quoted(&name);
            let message =
                format!("the gesture moves nothing: the file has a curve {quoted}, which does not move there");
            (message, "write the gesture into the curve, or remove one of the two")
        }
        false if gesture.frame as usize >= clip.frames.len() => {
            ("the gesture moves nothing: the clip ends where it starts".to_owned(), "put it into an earlier segment")
        }
        false => {
            let message = "the gesture moves nothing: another one is under way on its curve".to_owned();
            (message, "put it into a later segment, or remove one of the two")
        }
    };
    Diagnostic::at(Code::GestureHidden, span, message).help(help)
}
