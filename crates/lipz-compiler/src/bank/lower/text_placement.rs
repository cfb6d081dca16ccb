//! Detection of clips with equal texts, which a bank stores once.

use super::numbering::Numbering;
use super::repeated_hashes::RepeatedHashes;
use super::texts::TextRun;
use foldhash::{HashMap, HashMapExt}; // seeded differently in each process; the order of entries is never used

/// The position of the texts of a clip in a locale.
#[derive(Clone, Copy)]
pub(super) enum TextPlacement {
    /// There are no texts.
    None,
    /// Texts with this hash. Their position is still to be determined.
    Hashed(u32),
    /// They follow those before them.
    Next,
    /// They follow those before them, and other clips share them.
    NextForOthers,
    /// They equal those of the clip at this position in the order.
    As(u32),
}

/// Returns the position of the texts of each clip, in order, in each of this number of locales. `runs` returns those of
/// a clip.
///
/// One pass over the clips serves all locales, and the data per clip is small, because memory access dominates the
/// time.
pub(super) fn places<'c, R: Iterator<Item = (usize, TextRun<'c>)>>(
    numbering: &Numbering,
    runs: impl Fn(usize) -> R,
    column_count: usize,
) -> Vec<Vec<TextPlacement>> {
    let mut columns = vec![vec![TextPlacement::None; numbering.order().len()]; column_count];
    for (at, clip) in numbering.order().enumerate() {
        for (number, run) in runs(clip) {
            if let Some(column) = columns.get_mut(number) {
                column[at] = if run.stands_apart { TextPlacement::Next } else { TextPlacement::Hashed(run.hash) };
            }
        }
    }
    for (number, column) in columns.iter_mut().enumerate() {
        decide(column, numbering, |clip| runs(clip).find(|(of_run, _)| *of_run == number).map(|(_, run)| run));
    }
    columns
}

/// Determines the position of texts that have a hash.
fn decide<'c>(places: &mut [TextPlacement], numbering: &Numbering, run: impl Fn(usize) -> Option<TextRun<'c>>) {
    let mut repeated = RepeatedHashes::among(places.len());
    for place in &*places {
        if let TextPlacement::Hashed(hash) = place {
            repeated.add(*hash);
        }
    }
    // The first position with a hash; and for each, the next one with the same hash but different texts.
    let mut firsts: HashMap<u32, u32> = HashMap::new();
    let mut others: HashMap<u32, u32> = HashMap::new();
    for at in 0..places.len() as u32 {
        let TextPlacement::Hashed(hash) = places[at as usize] else { continue };
        places[at as usize] = TextPlacement::Next;
        let own = repeated.has(hash).then(|| run(numbering.clip(at as usize))).flatten();
        let Some(own) = own else { continue };
        let mut first = *firsts.entry(hash).or_insert(at);
        // Different segments make different texts.
        while first != at && !run(numbering.clip(first as usize)).is_some_and(|run| run.is_same(&own)) {
            first = *others.entry(first).or_insert(at);
        }
        if first != at {
            places[first as usize] = TextPlacement::NextForOthers;
            places[at as usize] = TextPlacement::As(first);
        }
    }
}
