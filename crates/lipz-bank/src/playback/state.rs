//! The lasting effects of events: emotions, stares and pointing.

use super::{DueSegments, due};
use crate::{Command, Event, EventName};
use core::iter::FusedIterator;

/// The most segments and events that one query evaluates, which is far more than clips have. In a forged bank,
/// thousands of segments can share one string of thousands of events; this limit keeps it from stopping a program.
const MAX_STEPS: u32 = 1 << 20;

/// The lasting effects of a character's events (Lipz specification, "Character Event Syntax").
///
/// `sees`, `does` and gestures such as `nods` are momentary and leave no state.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
#[non_exhaustive]
pub struct CharacterState<'a> {
    /// The emotion of the character, until changed; `None` if no event has set it.
    pub emotion: Option<EventName<'a>>,
    /// The target of the character's stare, until `stops staring`.
    pub stares_at: Option<EventName<'a>>,
    /// The target at which the character points, until `stops pointing`.
    pub points_at: Option<EventName<'a>>,
}

impl<'a> CharacterState<'a> {
    /// Applies `command` to the state.
    pub fn apply(&mut self, command: Command<EventName<'a>>) {
        match command {
            Command::Feels(emotion) => self.emotion = Some(emotion),
            Command::Stares(target) => self.stares_at = Some(target),
            Command::StopsStaring => self.stares_at = None,
            Command::Points(target) => self.points_at = Some(target),
            Command::StopsPointing => self.points_at = None,
            _ => {} // momentary
        }
    }
}

/// Returns the state of `character` after the events of `segments`; `None` stands for the speaker.
pub(super) fn after<'a>(segments: DueSegments<'a>, character: Option<EventName<'_>>) -> CharacterState<'a> {
    let speaker = segments.speaker_name();
    let is_asked = |of: Option<EventName<'_>>| match (of, character) {
        (Some(of), Some(asked)) => of == asked,
        (None, None) => true,
        (Some(of), None) => speaker == Some(of),
        (None, Some(_)) => false,
    };
    let mut state = CharacterState::default();
    each_event(segments, &mut { MAX_STEPS }, |event| {
        if is_asked(event.character) {
            state.apply(event.command);
        }
    });
    state
}

/// Calls `see` with the events of `segments`, while `steps` are left.
fn each_event<'a>(segments: DueSegments<'a>, steps: &mut u32, mut see: impl FnMut(Event<'a>)) {
    let speaker = segments.speaker_name();
    for segment in segments {
        for event in due::events(&segment, speaker).map(Some).chain([None]) {
            match steps.checked_sub(1) {
                Some(left) => *steps = left,
                None => return,
            }
            if let Some(event) = event {
                see(event);
            }
        }
    }
}

/// The characters of a clip with their states, ordered by name.
#[derive(Clone)]
pub(super) struct Characters<'a> {
    /// All segments, whose events name the characters.
    all: DueSegments<'a>,
    /// The segments whose events determine the states.
    past: DueSegments<'a>,
    /// The last character returned: first the speaker without a name, then by name.
    last: Option<Option<EventName<'a>>>,
    steps: u32,
}

impl<'a> Characters<'a> {
    pub(super) fn new(all: DueSegments<'a>, past: DueSegments<'a>) -> Self {
        Characters { all, past, last: None, steps: MAX_STEPS }
    }
}

impl<'a> Iterator for Characters<'a> {
    type Item = (Option<EventName<'a>>, CharacterState<'a>);

    fn next(&mut self) -> Option<Self::Item> {
        let last = self.last;
        let mut next: Option<Option<EventName<'a>>> = None;
        each_event(self.all.clone(), &mut self.steps, |event| {
            let is_new = last.map_or(true, |last| event.character > last);
            if is_new && next.map_or(true, |next| event.character < next) {
                next = Some(event.character);
            }
        });
        let character = next?;
        self.last = next;
        Some((character, after(self.past.clone(), character)))
    }
}

impl FusedIterator for Characters<'_> {}
