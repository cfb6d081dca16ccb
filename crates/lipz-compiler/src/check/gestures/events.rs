//! Gestures in events: `nods 4`, `mara looks away`.

use super::gesture::{Gesture, MOST};
use super::shapes::GestureKind;
use crate::clip::ClipData;
use crate::project::options::Gestures;
use lipz_bank::curve::CurveValue;
use lipz_diagnostics::{Code, Diagnostic, Span, escape};
use lipz_file::event::{self, Command, Event};
use lipz_file::{JsonString, text};

/// The angle of the eyes when they look away, in thousandths of a degree. It exceeds the 20 degrees after which the
/// head follows.
const AWAY: i32 = 25_000;
/// The closing of the eyelids, in thousandths.
const CLOSED: i32 = 1000;

/// Returns the gestures in a clip's events with the positions of the events.
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

/// Returns the gesture of an event, and its default strength.
fn kind_of(event: &Event<'_>, own: &Gestures) -> Option<(GestureKind, i32)> {
    match event.command {
        Command::Nods(_) => Some((GestureKind::Nod, own.nods_thousandths)),
        Command::Shakes(_) => Some((GestureKind::Shake, own.nods_thousandths)),
        Command::Breathes(_) => Some((GestureKind::Breath, own.breath_thousandths)),
        Command::Blinks => Some((GestureKind::Blink, CLOSED)),
        Command::LooksAway => Some((GestureKind::LookAway, AWAY)),
        _ => None,
    }
}

fn too_high(event: &Event<'_>, strength: i32, span: Span) -> Diagnostic {
    let value = CurveValue::from_thousandths(strength);
    let message = format!("{} {value} is outside 0 to 10", event.command.verb());
    Diagnostic::at(Code::GestureValue, span, message)
        .note("the gesture is limited to 10")
        .help("write a number from 0 to 10")
}

/// Returns the diagnostic for the first gesture of a clip without a frame rate.
pub(super) fn without_fps((_, span): &(Gesture<'_>, Span)) -> Diagnostic {
    Diagnostic::at(Code::GestureHidden, *span, "the gesture has no effect because the clip has no frame rate")
        .note("a gesture takes time, which lipz converts to frames")
        .help("add `fps` to the file, or `default-fps` to lipz.toml for all files without it")
}

/// Returns the diagnostic for a gesture that does not move a curve, either because the curves of the file are constant
/// or because there is no room for it.
pub(super) fn hidden(gesture: &Gesture<'_>, span: Span, is_still: bool, clip: &ClipData) -> Diagnostic {
    let (message, help) = match is_still {
        true => {
            let name = gesture.kind.paths().first().map_or(String::new(), |(curve, _)| gesture.name_of(*curve));
            let quoted = escape::quoted(&name);
            let message =
                format!("the gesture has no effect because the curve {quoted} of the file is constant at that time");
            (message, "write the gesture into the curve, or remove one of the two")
        }
        false if gesture.frame as usize >= clip.frames.len() => (
            "the gesture has no effect because the clip ends where it starts".to_owned(),
            "move it to an earlier segment",
        ),
        false => {
            let message = "the gesture has no effect because another gesture is in progress on its curve".to_owned();
            (message, "move it to a later segment, or remove one of the two")
        }
    };
    Diagnostic::at(Code::GestureHidden, span, message).help(help)
}
