//! Recalling many clips on all threads, once it is known that the old bank is not the new one.

use super::recall::Recall;
use crate::Input;
use crate::clip::{Batches, ClipData, Clips};
use crate::parallel;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Clips that a thread takes at a time: so many that it reads stretches of the old bank.
const CLIPS_AT_ONCE: usize = 1024;

/// The clips of inputs, given by their numbers; `None` if the old bank does not have them any more. They come in its order,
/// and so do its bytes.
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
