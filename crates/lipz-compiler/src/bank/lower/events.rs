//! The events: references from segments, records of distinct strings, the typed events in these, and their names.

use super::limits::fit;
use crate::clip::Clip;
use foldhash::{HashMap, HashMapExt, HashSet}; // seeded randomly in each process, but the order of entries is never used
use lipz_diagnostics::Report;
use lipz_file::event::{self, Command, Event, Word};
use lipz_layout::{EventNameRecord, EventRecord, NO_NAME, TypedEventRecord, U32};
use lipz_layout::{VERB_BLINKS, VERB_BREATHES, VERB_LOOKS_AWAY, VERB_NODS, VERB_SHAKES};
use lipz_layout::{
    VERB_DOES, VERB_FEELS, VERB_POINTS, VERB_SEES, VERB_STARES, VERB_STOPS_POINTING, VERB_STOPS_STARING,
};

/// The sections of the events.
pub(super) struct Events {
    pub(super) references: Vec<U32>,
    pub(super) records: Vec<EventRecord>,
    pub(super) typed: Vec<TypedEventRecord>,
    pub(super) names: Vec<EventNameRecord>,
    /// Event strings, then names.
    pub(super) pool: String,
}

/// Numbers the distinct event strings in the order of their first use, and parses each once. Adds the sorted names in
/// events and those of curves.
pub(super) fn events<'c>(
    clips: &[Clip<'c>],
    with_curves: &[(usize, Clip<'c>)],
) -> Result<(Events, Vec<&'c str>), Report> {
    let mut references = Vec::new();
    let mut records = Vec::new();
    let mut parsed: Vec<Event<'c>> = Vec::new();
    let mut pool = String::new();
    let mut numbers: HashMap<&'c str, u32> = HashMap::with_capacity(clips.len());
    for clip in clips {
        for string in clip.events().into_iter().flatten() {
            let next = fit(records.len(), "events")?;
            let number = *numbers.entry(string).or_insert(next);
            if number == next {
                let typed_first = parsed.len();
                parsed.extend(event::parse(string).into_iter().flatten().filter(|event| verb(event).is_some()));
                records.push(EventRecord {
                    offset_bytes: fit(pool.len(), "events")?.into(),
                    length_bytes: fit(string.len(), "events")?.into(),
                    typed_first: fit(typed_first, "events")?.into(),
                    typed_count: fit(parsed.len() - typed_first, "events")?.into(),
                });
                pool.push_str(string);
            }
            references.push(number.into());
        }
    }
    let sorted = sorted_names(&parsed, with_curves);
    let typed = parsed.iter().map(|event| typed_record(event, &sorted)).collect();
    let names = name_records(&sorted, &mut pool)?;
    Ok((Events { references, records, typed, names, pool }, sorted))
}

/// Returns the distinct names in `events` and those of curves, sorted.
fn sorted_names<'e>(events: &[Event<'e>], with_curves: &[(usize, Clip<'e>)]) -> Vec<&'e str> {
    let words = events.iter().flat_map(|event| [event.character, second_word(event)]).flatten();
    let of_curves = with_curves.iter().flat_map(|(_, clip)| clip.curves()).map(|(name, _)| name);
    // There are few names, each used many times.
    let distinct: HashSet<&str> = words.map(|word| word.text).chain(of_curves).collect();
    let mut names: Vec<&str> = distinct.into_iter().collect();
    names.sort_unstable();
    names
}

/// Returns the record of an event whose names are in `sorted`.
fn typed_record(event: &Event<'_>, sorted: &[&str]) -> TypedEventRecord {
    let number = |word: Option<Word<'_>>| {
        let place = word.and_then(|word| sorted.binary_search(&word.text).ok());
        place.map_or(NO_NAME, |place| place as u32).into()
    };
    TypedEventRecord {
        character: number(event.character),
        object: number(second_word(event)),
        verb: verb(event).unwrap_or_default(),
        reserved: [0; 7],
    }
}

/// Returns the word after the verb: a name, or the number of a gesture.
fn second_word<'t>(event: &Event<'t>) -> Option<Word<'t>> {
    event.command.object().or(event.command.amount())
}

/// Returns the number of the verb of an event. Every verb of Lipz files has one.
fn verb(event: &Event<'_>) -> Option<u8> {
    Some(match event.command {
        Command::Feels(_) => VERB_FEELS,
        Command::Sees(_) => VERB_SEES,
        Command::Stares(_) => VERB_STARES,
        Command::StopsStaring => VERB_STOPS_STARING,
        Command::Points(_) => VERB_POINTS,
        Command::StopsPointing => VERB_STOPS_POINTING,
        Command::Does(_) => VERB_DOES,
        Command::Nods(_) => VERB_NODS,
        Command::Shakes(_) => VERB_SHAKES,
        Command::Breathes(_) => VERB_BREATHES,
        Command::Blinks => VERB_BLINKS,
        Command::LooksAway => VERB_LOOKS_AWAY,
        _ => return None,
    })
}

/// Adds the names to the pool.
fn name_records(names: &[&str], pool: &mut String) -> Result<Vec<EventNameRecord>, Report> {
    let mut place = |name: &str| {
        let offset_bytes = fit(pool.len(), "events")?.into();
        pool.push_str(name);
        Ok(EventNameRecord { offset_bytes, length_bytes: fit(name.len(), "events")?.into() })
    };
    names.iter().map(|name| place(name)).collect()
}
