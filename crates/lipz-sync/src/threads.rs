//! Work on several threads, with results in the order of the items.

use std::num::NonZero;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

/// Returns the results of `work` in the order of `items`, whichever thread finishes first. Uses at most `threads`, or
/// as many as the machine has.
pub(crate) fn map<'i, T: Sync, R: Send>(
    items: &'i [T],
    threads: Option<usize>,
    work: impl Fn(&'i T) -> R + Sync,
) -> Vec<R> {
    let count =
        threads.unwrap_or_else(|| thread::available_parallelism().map_or(1, NonZero::get)).clamp(1, items.len().max(1));
    let next = AtomicUsize::new(0);
    let results = Mutex::new(Vec::with_capacity(items.len()));
    let worker = || {
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            let Some(item) = items.get(index) else { return };
            let result = work(item);
            results.lock().unwrap_or_else(std::sync::PoisonError::into_inner).push((index, result));
        }
    };
    thread::scope(|scope| {
        // If the system cannot start more threads, fewer do the work.
        for _ in 1..count {
            let _ = thread::Builder::new().spawn_scoped(scope, worker);
        }
        worker();
    });
    let mut results = results.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner);
    results.sort_unstable_by_key(|(index, _)| *index);
    results.into_iter().map(|(_, result)| result).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_are_in_the_order_of_the_items() {
        let items: Vec<usize> = (0..1000).collect();
        for threads in [None, Some(1), Some(7), Some(5000)] {
            assert_eq!(map(&items, threads, |item| item * 2), (0..2000).step_by(2).collect::<Vec<_>>());
        }
        assert_eq!(map(&[] as &[u8], None, |_| 0), [0; 0]);
    }
}
