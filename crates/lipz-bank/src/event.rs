//! Typed events: what the event string of a segment says, if it is Character Event Syntax.

use core::cmp::Ordering;
use core::fmt;
use core::hash::{Hash, Hasher};
use core::iter::FusedIterator;

use crate::pool::Pool;
use crate::{Bank, Command};
use lipz_layout::{EventNameRecord, EventRecord, NO_NAME, TypedEventRecord};
use lipz_layout::{VERB_DOES, VERB_FEELS, VERB_POINTS, VERB_SEES, VERB_STARES};
use lipz_layout::{VERB_STOPS_POINTING, VERB_STOPS_STARING};

/// A name that events mention: a character, an emotion, a target or an action.
///
/// Equal names of a bank have equal ids. Two names compare as their ids do, and those are in the order
/// of the names: compare names of one bank only.
#[derive(Clone, Copy)]
pub struct EventName<'data> {
    id: u32,
    record: &'data EventNameRecord,
    strings: Pool<'data>,
}

impl<'data> EventName<'data> {
    /// The name with this number, if there is one.
    fn at(names: &'data [EventNameRecord], strings: Pool<'data>, id: u32) -> Option<Self> {
        Some(EventName { id, record: names.get(id as usize)?, strings })
    }

    /// The name that is spelled so.
    pub(crate) fn find(bank: &Bank<'data>, name: &str) -> Option<Self> {
        let bytes = |record: &EventNameRecord| {
            let start = record.offset_bytes.get() as usize;
            bank.event_strings.slice(start, start.checked_add(record.length_bytes.get() as usize)?)
        };
        let id = bank.event_names.partition_point(|record| bytes(record) < Some(name.as_bytes()));
        let found = EventName::at(bank.event_names, bank.event_strings, id as u32)?;
        if bytes(found.record) == Some(name.as_bytes()) { Some(found) } else { None }
    }

    /// The number of the name in this bank. It is the same as long as the bank is, and another one
    /// when the bank is packed again.
    pub const fn id(self) -> u32 {
        self.id
    }

    /// The name as it is spelled in the Lipz file. Empty only in a damaged bank.
    pub fn as_str(self) -> &'data str {
        self.strings.text_at(self.record.offset_bytes.get(), self.record.length_bytes.get()).unwrap_or("")
    }
}

impl PartialEq for EventName<'_> {
    fn eq(&self, other: &Self) -> bool {
        self.id == other.id
    }
}
impl Eq for EventName<'_> {}

impl PartialOrd for EventName<'_> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for EventName<'_> {
    fn cmp(&self, other: &Self) -> Ordering {
        self.id.cmp(&other.id)
    }
}

impl Hash for EventName<'_> {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.id.hash(state);
    }
}

impl fmt::Display for EventName<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.as_str())
    }
}

/// The id and the name.
impl fmt::Debug for EventName<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "EventName({}, {:?})", self.id, self.as_str())
    }
}

/// One event: `[character] verb …`. It is displayed as it is written in Lipz files.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Event<'data> {
    /// Who; `None` for the speaker of the clip.
    pub character: Option<EventName<'data>>,
    /// What.
    pub command: Command<EventName<'data>>,
}

impl<'data> Event<'data> {
    /// The event of a record, unless that is damaged.
    pub(crate) fn of(names: &'data [EventNameRecord], strings: Pool<'data>, record: &TypedEventRecord) -> Option<Self> {
        let name = |id| EventName::at(names, strings, id);
        let object = name(record.object.get());
        let command = match record.verb {
            VERB_FEELS => Command::Feels(object?),
            VERB_SEES => Command::Sees(object?),
            VERB_STARES => Command::Stares(object?),
            VERB_POINTS => Command::Points(object?),
            VERB_DOES => Command::Does(object?),
            _ if record.object.get() != NO_NAME => return None,
            VERB_STOPS_STARING => Command::StopsStaring,
            VERB_STOPS_POINTING => Command::StopsPointing,
            _ => return None,
        };
        let character = match record.character.get() {
            NO_NAME => None,
            id => Some(name(id)?),
        };
        Some(Event { character, command })
    }
}

impl fmt::Display for Event<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(character) = self.character {
            f.write_str(character.as_str())?;
            f.write_str(" ")?;
        }
        f.write_str(self.command.verb())?;
        match self.command.object() {
            Some(object) => {
                f.write_str(" ")?;
                f.write_str(object.as_str())
            }
            None => Ok(()),
        }
    }
}

/// The events of a segment in the order of their string; see [`Segment::events`](crate::Segment::events).
#[derive(Clone)]
pub struct Events<'data> {
    records: &'data [TypedEventRecord],
    names: &'data [EventNameRecord],
    strings: Pool<'data>,
}

impl<'data> Events<'data> {
    /// The events of an event string; none if that is damaged.
    pub(crate) fn new(bank: &Bank<'data>, of: Option<&EventRecord>) -> Self {
        let records = of.and_then(|record| typed_events(bank, record)).unwrap_or(&[]);
        Events { records, names: bank.event_names, strings: bank.event_strings }
    }
}

/// The records of the events that an event string is made of; `None` if damaged.
pub(crate) fn typed_events<'data>(bank: &Bank<'data>, record: &EventRecord) -> Option<&'data [TypedEventRecord]> {
    let first = record.typed_first.get() as usize;
    bank.typed_events.get(first..first.checked_add(record.typed_count.get() as usize)?)
}

impl<'data> Iterator for Events<'data> {
    type Item = Event<'data>;

    fn next(&mut self) -> Option<Event<'data>> {
        let (record, rest) = self.records.split_first()?;
        let event = Event::of(self.names, self.strings, record);
        // A damaged record ends the iteration.
        self.records = if event.is_some() { rest } else { &[] };
        event
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        (0, Some(self.records.len()))
    }
}

impl FusedIterator for Events<'_> {}

/// The events.
impl fmt::Debug for Events<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.clone()).finish()
    }
}
