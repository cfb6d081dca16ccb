//! Recalling many clips on all threads, after the old bank is known to differ from the new one.

use super::recall::Recall;
use crate::clip::{Batches, ClipData, Clips};
use crate::sources::Input;
use crate::util::parallel;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The number of clips that a thread takes at a time, so many that it reads whole ranges of the old bank.
const CLIPS_AT_ONCE: usize = 1024;

/// Returns the clips of the inputs with these numbers; `None` if the old bank has changed. They are sorted as in the
/// bank, so that its bytes are read in order.
pub(super) fn recalled(
    recall: &Recall<'_>,
    inputs: &[Input],
    found: &[u32],
    threads: Option<usize>,
) -> Option<Vec<Clips>> {
    let of_input = |&index: &u32| Some((index, recall.slot(&inputs.get(index as usize)?.key)?));
    let mut order: Vec<(u32, u32)> = found.iter().map(of_input).collect::<Option<_>>()?;
    order.sort_unstable_by_key(|(_, slot)| recall.place(*slot));
    let next = AtomicUsize::new(0);
    let batches = parallel::workers(threads, || {
        let (mut clips, mut clip) = (Batches::default(), ClipData::default());
        let mut recaller = recall.recaller(clips.locales());
        loop {
            let first = next.fetch_add(CLIPS_AT_ONCE, Ordering::Relaxed);
            let Some(behind) = order.get(first..).filter(|behind| !behind.is_empty()) else {
                return Some(clips.into_all());
            };
            for (index, slot) in behind.iter().take(CLIPS_AT_ONCE) {
                recaller.clip(*slot, &mut clip)?;
                clips.push(&inputs.get(*index as usize)?.key, &clip);
            }
        }
    });
    let batches: Option<Vec<Vec<Clips>>> = batches.into_iter().collect();
    batches.filter(|_| recall.is_whole()).map(|batches| batches.into_iter().flatten().collect())
}
