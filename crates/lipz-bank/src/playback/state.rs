//! What outlasts an event: what characters feel, stare and point at.

use super::{DueSegments, due};
use crate::{Command, Event, EventName};
use core::iter::FusedIterator;

/// Segments and events that one query looks at: far more than clips have. It keeps a forged bank, in which
/// thousands of segments share one string of thousands of events, from stopping a program.
const MAX_STEPS: u32 = 1 << 20;

/// What of a character's events lasts (Lipz specification, "Character Event Syntax").
///
/// `sees`, `does` and gestures such as `nods` are for a moment and leave no state.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
#[non_exhaustive]
pub struct CharacterState<'data> {
    /// What the character feels, until changed; `None` if no event has said.
    pub emotion: Option<EventName<'data>>,
    /// What the character stares at, until `stops staring`.
    pub stares_at: Option<EventName<'data>>,
    /// What the character points at, until `stops pointing`.
    pub points_at: Option<EventName<'data>>,
}

impl<'data> CharacterState<'data> {
    /// The character does `command`.
    pub fn apply(&mut self, command: Command<EventName<'data>>) {
        match command {
            Command::Feels(emotion) => self.emotion = Some(emotion),
            Command::Stares(target) => self.stares_at = Some(target),
            Command::StopsStaring => self.stares_at = None,
            Command::Points(target) => self.points_at = Some(target),
            Command::StopsPointing => self.points_at = None,
            Command::Sees(_) | Command::Does(_) | Command::LooksAway => {}
            Command::Nods(_) | Command::Shakes(_) | Command::Breathes(_) | Command::Blinks => {}
        }
    }
}

/// The state of `character` after the events of `segments`; `None` stands for the speaker.
pub(super) fn after<'data>(
    segments: DueSegments<'data, '_>,
    character: Option<EventName<'_>>,
) -> CharacterState<'data> {
    let character = character.map(EventName::key).or(segments.speaker());
    let mut state = CharacterState::default();
    each_event(segments, &mut { MAX_STEPS }, |event| {
        if event.character.map(EventName::key) == character {
            state.apply(event.command);
        }
    });
    state
}

/// Calls `see` with the events of `segments`, as long as there are `steps` left.
fn each_event<'data>(segments: DueSegments<'data, '_>, steps: &mut u32, mut see: impl FnMut(Event<'data>)) {
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

/// The characters of a clip with their states, in the order of their names; see
/// [`Cursor::characters`](crate::Cursor::characters).
#[derive(Clone, Debug)]
pub struct Characters<'data, 'bank> {
    /// All segments, whose events have the characters.
    all: DueSegments<'data, 'bank>,
    /// Those whose events make the states.
    past: DueSegments<'data, 'bank>,
    /// The last one given: first the speaker without a name, then by name.
    last: Option<Option<EventName<'data>>>,
    steps: u32,
}

impl<'data, 'bank> Characters<'data, 'bank> {
    pub(super) fn new(all: DueSegments<'data, 'bank>, past: DueSegments<'data, 'bank>) -> Self {
        Characters { all, past, last: None, steps: MAX_STEPS }
    }
}

impl<'data> Iterator for Characters<'data, '_> {
    type Item = (Option<EventName<'data>>, CharacterState<'data>);

    fn next(&mut self) -> Option<Self::Item> {
        let last = self.last;
        let mut next: Option<Option<EventName<'data>>> = None;
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

impl FusedIterator for Characters<'_, '_> {}
