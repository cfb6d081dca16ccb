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

/// What becomes of the texts of each clip, clips in their order, in each of so many locales. `runs` gives those of a clip.
///
/// The clips are gone through once for all locales, and what is asked for each of them is small: otherwise all waits for
/// memory.
pub(super) fn places<'c, R: Iterator<Item = (usize, Run<'c>)>>(
    numbering: &Numbering,
    runs: impl Fn(usize) -> R,
    column_count: usize,
) -> Vec<Vec<Place>> {
    let mut columns = vec![vec![Place::None; numbering.order().len()]; column_count];
    for (at, clip) in numbering.order().enumerate() {
        for (number, run) in runs(clip) {
            if let Some(column) = columns.get_mut(number) {
                column[at] = if run.stands_apart { Place::Next } else { Place::Hashed(run.hash) };
            }
        }
    }
    for (number, column) in columns.iter_mut().enumerate() {
        decide(column, numbering, |clip| runs(clip).find(|(of_run, _)| *of_run == number).map(|(_, run)| run));
    }
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
