//! Checks event strings, their typed events, and the names in these.

use super::error_at;
use super::strings::Strings;
use crate::event::{Event, typed_events};
use crate::{Bank, Error, ErrorKind};

/// Checks the event sections, each entry once.
pub(super) fn events(bank: &Bank<'_>) -> Result<(), Error> {
    let strings_end = strings(bank)?;
    names(bank, strings_end)?;
    for typed in bank.typed_events {
        if Event::new(bank, typed).is_none() {
            return Err(error_at(bank, ErrorKind::TypedEvent, typed));
        }
    }
    for reference in bank.event_refs {
        if reference.get() as usize >= bank.events.len() {
            return Err(error_at(bank, ErrorKind::EventReference, reference));
        }
    }
    Ok(())
}

/// Checks that event strings follow each other in their pool, and that their typed events follow each other and fill
/// the table. Returns the end of the strings.
fn strings(bank: &Bank<'_>) -> Result<u32, Error> {
    let mut strings = Strings::new(bank.event_strings, 0);
    let mut typed_end = 0_u32;
    for record in bank.events {
        let (offset, length) = (record.offset_bytes.get(), record.length_bytes.get());
        if bank.event_strings.text_at(offset, length).is_none() || !strings.follows(offset, length) {
            return Err(error_at(bank, ErrorKind::EventReference, record));
        }
        if record.typed_first.get() != typed_end || typed_events(bank, record).is_none() {
            return Err(error_at(bank, ErrorKind::TypedEvent, record));
        }
        typed_end = typed_end.wrapping_add(record.typed_count.get());
    }
    if typed_end as usize != bank.typed_events.len() {
        return Err(error_at(bank, ErrorKind::TypedEvent, bank.typed_events));
    }
    Ok(strings.end())
}

/// Checks that names ascend strictly and fill the pool from `start` on.
fn names(bank: &Bank<'_>, start: u32) -> Result<(), Error> {
    let mut names = Strings::new(bank.event_strings, start);
    for record in bank.event_names {
        if names.next_ascending(record.offset_bytes.get(), record.length_bytes.get()).is_none() {
            return Err(error_at(bank, ErrorKind::EventName, record));
        }
    }
    if !names.fill_the_pool() {
        return Err(error_at(bank, ErrorKind::EventName, bank.event_names));
    }
    Ok(())
}
