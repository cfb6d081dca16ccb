//! Which clips have the same texts: those stand in the bank once.

use super::numbering::Numbering;
use super::repeated::Repeated;
use super::texts::Run;
use foldhash::{HashMap, HashMapExt}; // seeded anew in each process: the order of entries is never used

/// What becomes of the texts of a clip in a locale.
#[derive(Clone, Copy)]
pub(super) enum Place {
    /// There are none.
    None,
    /// They have this hash; what becomes of them is not decided yet.
    Hashed(u32),
    /// They stand behind those so far.
    Next,
    /// The same, and other clips have them, too.
    NextForOthers,
    /// The clip with this place in the order has the same.
    As(u32),
}

/// What becomes of the texts of each clip, clips in their order, in each of so many locales.
///
/// The clips are gone through once for all locales, and what is asked for each of them is small: otherwise all waits for
/// memory.
pub(super) fn places<'c>(
    numbering: &Numbering,
    run: &impl Fn(usize, usize) -> Option<Run<'c>>,
    column_count: usize,
) -> Vec<Vec<Place>> {
    let mut columns: Vec<Vec<Place>> = (0..column_count).map(|_| Vec::with_capacity(numbering.order().len())).collect();
    for clip in numbering.order() {
        for (number, column) in columns.iter_mut().enumerate() {
            column.push(match run(number, clip) {
                Some(own) if own.stands_apart => Place::Next,
                Some(own) => Place::Hashed(own.hash),
                None => Place::None,
            });
        }
    }
    columns.iter_mut().enumerate().for_each(|(number, column)| decide(column, numbering, |clip| run(number, clip)));
    columns
}

/// Decides what becomes of texts that have a hash.
fn decide<'c>(places: &mut [Place], numbering: &Numbering, run: impl Fn(usize) -> Option<Run<'c>>) {
    let mut repeated = Repeated::among(places.len());
    for place in &*places {
        if let Place::Hashed(hash) = place {
            repeated.add(*hash);
        }
    }
    // The first place with a hash; and behind each, the next one that has its hash, but other texts.
    let mut firsts: HashMap<u32, u32> = HashMap::new();
    let mut others: HashMap<u32, u32> = HashMap::new();
    for at in 0..places.len() as u32 {
        let Place::Hashed(hash) = places[at as usize] else { continue };
        places[at as usize] = Place::Next;
        let own = repeated.has(hash).then(|| run(numbering.clip(at as usize))).flatten();
        let Some(own) = own else { continue };
        let mut first = *firsts.entry(hash).or_insert(at);
        // Other segments are other texts.
        while first != at && !run(numbering.clip(first as usize)).is_some_and(|run| run.is_same(&own)) {
            first = *others.entry(first).or_insert(at);
        }
        if first != at {
            places[first as usize] = Place::NextForOthers;
            places[at as usize] = Place::As(first);
        }
    }
}
