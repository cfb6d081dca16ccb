//! The events: references of segments, records of distinct strings, and their pool.

use super::fit;
use crate::Report;
use crate::clip::Clip;
use foldhash::{HashMap, HashMapExt}; // seeded anew in each process: the order of entries is never used
use lipz_bank::layout::{EventRecord, NO_EVENTS, U32};

/// Event references, records and strings.
pub(super) struct Events {
    /// Index of each clip's first reference, or `NO_EVENTS`.
    pub(super) first: Vec<u32>,
    pub(super) references: Vec<U32>,
    pub(super) records: Vec<EventRecord>,
    pub(super) pool: String,
}

/// Numbers the distinct event strings in the order of their first use.
pub(super) fn events(clips: &[Clip<'_>]) -> Result<Events, Report> {
    let mut events = Events {
        first: Vec::with_capacity(clips.len()),
        references: Vec::new(),
        records: Vec::new(),
        pool: String::new(),
    };
    let mut numbers: HashMap<&str, u32> = HashMap::with_capacity(clips.len());
    for clip in clips {
        events.first.push(match clip.events() {
            Some(_) => fit(events.references.len(), "events")?,
            None => NO_EVENTS,
        });
        for event in clip.events().into_iter().flatten() {
            let next = fit(events.records.len(), "events")?;
            let number = *numbers.entry(event).or_insert(next);
            if number == next {
                events.records.push(EventRecord {
                    offset_bytes: fit(events.pool.len(), "events")?.into(),
                    length_bytes: fit(event.len(), "events")?.into(),
                });
                events.pool.push_str(event);
            }
            events.references.push(number.into());
        }
    }
    Ok(events)
}
