//! Typed events: what the event string of a segment says, if it is Character Event Syntax.

use core::cmp::Ordering;
use core::fmt;
use core::hash::{Hash, Hasher};
use core::iter::FusedIterator;

use crate::origin::Origin;
use crate::pool::Pool;
use crate::{Bank, Command};
use lipz_layout::{EventNameRecord, EventRecord, NO_NAME, TypedEventRecord};
use lipz_layout::{VERB_BLINKS, VERB_BREATHES, VERB_LOOKS_AWAY, VERB_NODS, VERB_SHAKES};
use lipz_layout::{VERB_DOES, VERB_FEELS, VERB_POINTS, VERB_SEES, VERB_STARES};
use lipz_layout::{VERB_STOPS_POINTING, VERB_STOPS_STARING};

/// A name that events mention: a character, an emotion, a target or an action.
///
/// Names know their bank. Equal are names of one bank that are spelled alike; names of two banks are never
/// equal, however they are spelled: compare [`EventName::as_str`] there. Names of one bank are in the order of
/// their strings.
#[derive(Clone, Copy)]
pub struct EventName<'data> {
    key: NameKey,
    record: &'data EventNameRecord,
    strings: Pool<'data>,
}

/// What identifies a name, and borrows nothing: its bank, and its number there.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub(crate) struct NameKey {
    bank: Origin,
    id: u32,
}

impl NameKey {
    /// Whether the name is one of `bank`.
    pub(crate) fn is_of(&self, bank: &Bank<'_>) -> bool {
        self.bank == bank.origin()
    }
}

impl<'data> EventName<'data> {
    /// The number of the name in this bank. It is the same as long as the bank is, and another one
    /// when the bank is packed again.
    pub const fn id(self) -> u32 {
        self.key.id
    }

    /// The name as it is spelled in the Lipz file. Empty only in a damaged bank.
    pub fn as_str(self) -> &'data str {
        self.strings.text_at(self.record.offset_bytes.get(), self.record.length_bytes.get()).unwrap_or("")
    }

    /// The bytes of the name, which nobody has to check to be UTF-8 to compare them with known names; none of a damaged one.
    pub(crate) fn bytes(self) -> &'data [u8] {
        let start = self.record.offset_bytes.get() as usize;
        let end = start.saturating_add(self.record.length_bytes.get() as usize);
        self.strings.slice(start, end).unwrap_or(&[])
    }

    /// Whether the name is one of `bank`.
    pub fn is_of(self, bank: &Bank<'_>) -> bool {
        self.key.is_of(bank)
    }

    /// A debug assertion that the name is one of `bank`.
    #[inline(always)]
    pub(crate) fn assert_is_of(self, bank: &Bank<'_>) {
        self.key.bank.assert_is(bank.origin());
    }

    /// What identifies the name.
    pub(crate) fn key(self) -> NameKey {
        self.key
    }
}

impl PartialEq for EventName<'_> {
    fn eq(&self, other: &Self) -> bool {
        self.key == other.key
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
        self.key.cmp(&other.key)
    }
}

impl Hash for EventName<'_> {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.key.hash(state);
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
        write!(f, "EventName({}, {:?})", self.id(), self.as_str())
    }
}

/// The names in the events of a bank.
#[derive(Clone, Copy)]
pub(crate) struct EventNames<'data> {
    bank: Origin,
    records: &'data [EventNameRecord],
    strings: Pool<'data>,
}

impl<'data> Bank<'data> {
    /// The names in events.
    #[inline]
    pub(crate) fn event_names(&self) -> EventNames<'data> {
        EventNames { bank: self.origin(), records: self.event_names, strings: self.event_strings }
    }
}

impl<'data> EventNames<'data> {
    /// The name with this number, if there is one.
    pub(crate) fn numbered(&self, id: u32) -> Option<EventName<'data>> {
        let record = self.records.get(id as usize)?;
        Some(EventName { key: NameKey { bank: self.bank, id }, record, strings: self.strings })
    }

    /// The name of this bank that `key` identifies.
    pub(crate) fn named(&self, key: NameKey) -> Option<EventName<'data>> {
        self.numbered(key.id)
    }

    /// The name that is spelled so.
    pub(crate) fn find(&self, name: &str) -> Option<EventName<'data>> {
        let bytes = |record: &EventNameRecord| {
            let start = record.offset_bytes.get() as usize;
            self.strings.slice(start, start.checked_add(record.length_bytes.get() as usize)?)
        };
        let id = self.records.partition_point(|record| bytes(record) < Some(name.as_bytes()));
        let found = self.numbered(id as u32)?;
        if bytes(found.record) == Some(name.as_bytes()) { Some(found) } else { None }
    }
}

/// One event: `[character] verb …`. It is displayed as it is written in Lipz files.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[non_exhaustive]
pub struct Event<'data> {
    /// Who; `None` for the speaker of the clip.
    pub character: Option<EventName<'data>>,
    /// What.
    pub command: Command<EventName<'data>>,
}

impl<'data> Event<'data> {
    /// The event of a record, unless that is damaged.
    pub(crate) fn new(names: &EventNames<'data>, record: &TypedEventRecord) -> Option<Self> {
        let name = |id| names.numbered(id);
        let object = name(record.object.get());
        let maybe = |object: Option<_>| if record.object.get() == NO_NAME { Some(None) } else { object.map(Some) };
        let command = match record.verb {
            VERB_FEELS => Command::Feels(object?),
            VERB_SEES => Command::Sees(object?),
            VERB_STARES => Command::Stares(object?),
            VERB_POINTS => Command::Points(object?),
            VERB_DOES => Command::Does(object?),
            VERB_NODS => Command::Nods(maybe(object)?),
            VERB_SHAKES => Command::Shakes(maybe(object)?),
            VERB_BREATHES => Command::Breathes(maybe(object)?),
            _ if record.object.get() != NO_NAME => return None,
            VERB_STOPS_STARING => Command::StopsStaring,
            VERB_STOPS_POINTING => Command::StopsPointing,
            VERB_BLINKS => Command::Blinks,
            VERB_LOOKS_AWAY => Command::LooksAway,
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
    names: EventNames<'data>,
}

impl<'data> Events<'data> {
    /// The events of an event string; none if that is damaged.
    pub(crate) fn new(bank: &Bank<'data>, of: Option<&EventRecord>) -> Self {
        let records = of.and_then(|record| typed_events(bank, record)).unwrap_or(&[]);
        Events { records, names: bank.event_names() }
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
        let event = Event::new(&self.names, record);
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
