//! Typed events: a segment's event string, parsed as Character Event Syntax.

use core::cmp::Ordering;
use core::fmt;
use core::hash::{Hash, Hasher};
use core::iter::FusedIterator;

use crate::origin::Origin;
use crate::{Bank, Command, Strength};
use lipz_layout::{EventNameRecord, EventRecord, NO_NAME, TypedEventRecord};
use lipz_layout::{VERB_BLINKS, VERB_BREATHES, VERB_LOOKS_AWAY, VERB_NODS, VERB_SHAKES};
use lipz_layout::{VERB_DOES, VERB_FEELS, VERB_POINTS, VERB_SEES, VERB_STARES};
use lipz_layout::{VERB_STOPS_POINTING, VERB_STOPS_STARING};

/// A name that events mention: a character, an emotion, a target or an action.
///
/// Names from any banks are equal if they have the same spelling, and are ordered by their bytes. Compare them with
/// each other or with a string: `event.character.map_or(false, |name| name == "mara")`. Names of one bank are compared
/// as numbers.
#[derive(Clone, Copy)]
pub struct EventName<'a> {
    bank: &'a Bank<'a>,
    id: u32,
}

/// The identity of a name, which borrows nothing: its bank, and its number there.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) struct NameKey {
    pub(crate) bank: Origin,
    pub(crate) id: u32,
}

impl<'a> EventName<'a> {
    /// Returns the name with this number in a bank.
    #[inline]
    pub(crate) fn numbered(bank: &'a Bank<'a>, id: u32) -> Option<EventName<'a>> {
        bank.event_names.get(id as usize)?;
        Some(EventName { bank, id })
    }

    /// Returns the name as spelled in the Lipz file. Empty only in a damaged bank.
    pub fn as_str(self) -> &'a str {
        let record = self.record();
        record
            .and_then(|record| self.bank.event_strings.text_at(record.offset_bytes.get(), record.length_bytes.get()))
            .unwrap_or("")
    }

    /// Returns the bytes of the name, for comparison with known names without a UTF-8 check. Empty for a damaged name.
    pub(crate) fn bytes(self) -> &'a [u8] {
        self.record().and_then(|record| bytes_of(self.bank, record)).unwrap_or(&[])
    }

    fn record(self) -> Option<&'a EventNameRecord> {
        self.bank.event_names.get(self.id as usize)
    }

    /// Returns the name as numbers that borrow nothing, for a struct of another language:
    /// [`Dialogue::event_name_of_words`](crate::Dialogue::event_name_of_words).
    pub const fn to_words(self) -> [u32; 2] {
        [self.bank.origin.to_u32(), self.id]
    }

    /// Returns the number of the name in its bank.
    pub(crate) const fn id(self) -> u32 {
        self.id
    }

    /// Returns the identity of the name.
    pub(crate) const fn key(self) -> NameKey {
        NameKey { bank: self.bank.origin, id: self.id }
    }
}

impl NameKey {
    /// Returns the identity from [`EventName::to_words`].
    pub(crate) const fn from_words([bank, id]: [u32; 2]) -> NameKey {
        NameKey { bank: Origin::from_u32(bank), id }
    }
}

impl PartialEq for EventName<'_> {
    fn eq(&self, other: &Self) -> bool {
        match self.bank.origin == other.bank.origin {
            true => self.id == other.id,
            false => self.bytes() == other.bytes(),
        }
    }
}
impl Eq for EventName<'_> {}

impl PartialEq<str> for EventName<'_> {
    fn eq(&self, other: &str) -> bool {
        self.bytes() == other.as_bytes()
    }
}

impl PartialEq<&str> for EventName<'_> {
    fn eq(&self, other: &&str) -> bool {
        self == *other
    }
}

impl PartialOrd for EventName<'_> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for EventName<'_> {
    fn cmp(&self, other: &Self) -> Ordering {
        match self.bank.origin == other.bank.origin {
            true => self.id.cmp(&other.id), // ids are in the order of the bytes
            false => self.bytes().cmp(other.bytes()),
        }
    }
}

impl Hash for EventName<'_> {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.bytes().hash(state);
    }
}

impl fmt::Display for EventName<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.as_str())
    }
}

impl fmt::Debug for EventName<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "EventName({:?})", self.as_str())
    }
}

/// Returns the bytes of the name with this record, if they are in the bank.
fn bytes_of<'a>(bank: &Bank<'a>, record: &EventNameRecord) -> Option<&'a [u8]> {
    let start = record.offset_bytes.get() as usize;
    bank.event_strings.slice(start, start.checked_add(record.length_bytes.get() as usize)?)
}

impl Bank<'_> {
    /// Returns the name as spelled in events (`amy`); `None` if no event contains it.
    pub fn event_name(&self, name: &str) -> Option<EventName<'_>> {
        EventName::numbered(self, self.event_name_id(name.as_bytes())?)
    }

    /// Returns the number of the name with this spelling.
    pub(crate) fn event_name_id(&self, name: &[u8]) -> Option<u32> {
        let id = self.event_names.partition_point(|record| bytes_of(self, record) < Some(name));
        let found = bytes_of(self, self.event_names.get(id)?);
        if found == Some(name) { Some(id as u32) } else { None }
    }
}

/// One event: `[character] verb …`.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[non_exhaustive]
pub struct Event<'a> {
    /// The character that acts; `None` for the speaker of the clip.
    pub character: Option<EventName<'a>>,
    /// The action of the character.
    pub command: Command<EventName<'a>>,
}

impl<'a> Event<'a> {
    /// Returns the event of a record of a bank; `None` if it is damaged.
    pub(crate) fn new(bank: &'a Bank<'a>, record: &TypedEventRecord) -> Option<Self> {
        let name = |id| EventName::numbered(bank, id);
        let object = name(record.object.get());
        let strength = |object: Option<EventName<'_>>| match record.object.get() {
            NO_NAME => Some(None),
            _ => Strength::parse(object?.bytes()).map(Some),
        };
        let command = match record.verb {
            VERB_FEELS => Command::Feels(object?),
            VERB_SEES => Command::Sees(object?),
            VERB_STARES => Command::Stares(object?),
            VERB_POINTS => Command::Points(object?),
            VERB_DOES => Command::Does(object?),
            VERB_NODS => Command::Nods(strength(object)?),
            VERB_SHAKES => Command::Shakes(strength(object)?),
            VERB_BREATHES => Command::Breathes(strength(object)?),
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

/// Prints the event as written in Lipz files.
impl fmt::Display for Event<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(character) = self.character {
            f.write_str(character.as_str())?;
            f.write_str(" ")?;
        }
        f.write_str(self.command.verb())?;
        if let Some(object) = self.command.object() {
            f.write_str(" ")?;
            f.write_str(object.as_str())?;
        }
        match self.command.amount() {
            Some(strength) => write!(f, " {strength}"),
            None => Ok(()),
        }
    }
}

/// The events of a segment, in the order of its event string.
#[derive(Clone)]
pub(crate) struct Events<'a> {
    records: &'a [TypedEventRecord],
    bank: &'a Bank<'a>,
}

impl<'a> Events<'a> {
    /// Returns the events of an event string, or no events if it is damaged.
    pub(crate) fn new(bank: &'a Bank<'a>, of: Option<&EventRecord>) -> Self {
        let records = of.and_then(|record| typed_events(bank, record)).unwrap_or(&[]);
        Events { records, bank }
    }
}

/// Returns the records of the events in an event string; `None` if damaged.
pub(crate) fn typed_events<'data>(bank: &Bank<'data>, record: &EventRecord) -> Option<&'data [TypedEventRecord]> {
    let first = record.typed_first.get() as usize;
    bank.typed_events.get(first..first.checked_add(record.typed_count.get() as usize)?)
}

impl<'a> Iterator for Events<'a> {
    type Item = Event<'a>;

    fn next(&mut self) -> Option<Event<'a>> {
        let (record, rest) = self.records.split_first()?;
        let event = Event::new(self.bank, record);
        // A damaged record ends the iteration.
        self.records = if event.is_some() { rest } else { &[] };
        event
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        (0, Some(self.records.len()))
    }
}

impl FusedIterator for Events<'_> {}
