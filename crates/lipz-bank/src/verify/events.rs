//! Event strings, the typed events that they are made of, and the names in those.

use super::error_at;
use crate::event::{typed_events, Event};
use crate::{Bank, Error, ErrorKind};

/// Checks what the event sections hold, each entry once.
pub(super) fn events(bank: &Bank<'_>) -> Result<(), Error> {
    let strings_end = strings(bank)?;
    names(bank, strings_end)?;
    for typed in bank.typed_events {
        if Event::of(bank.event_names, bank.event_strings, typed).is_none() {
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

/// Event strings follow each other in their pool, and so do their typed events, which are all of the
/// table; returns where the strings end.
fn strings(bank: &Bank<'_>) -> Result<u32, Error> {
    let (mut end, mut typed_end) = (0_u32, 0_u32);
    for record in bank.events {
        let string = bank.event_strings.text_at(record.offset_bytes.get(), record.length_bytes.get());
        if string.is_none() || record.offset_bytes.get() != end {
            return Err(error_at(bank, ErrorKind::EventReference, record));
        }
        end = end.wrapping_add(record.length_bytes.get());
        if record.typed_first.get() != typed_end || typed_events(bank, record).is_none() {
            return Err(error_at(bank, ErrorKind::TypedEvent, record));
        }
        typed_end = typed_end.wrapping_add(record.typed_count.get());
    }
    if typed_end as usize != bank.typed_events.len() {
        return Err(error_at(bank, ErrorKind::TypedEvent, bank.typed_events));
    }
    Ok(end)
}

/// Names ascend strictly and fill the pool from `end` on.
fn names(bank: &Bank<'_>, mut end: u32) -> Result<(), Error> {
    let mut before = "";
    for record in bank.event_names {
        match bank.event_strings.text_at(record.offset_bytes.get(), record.length_bytes.get()) {
            Some(name) if name > before && record.offset_bytes.get() == end => before = name,
            _ => return Err(error_at(bank, ErrorKind::EventName, record)),
        }
        end = end.wrapping_add(record.length_bytes.get());
    }
    if end as usize != bank.event_strings.bytes().len() {
        return Err(error_at(bank, ErrorKind::EventName, bank.event_names));
    }
    Ok(())
}
