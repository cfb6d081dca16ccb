//! Work on several threads: with the feature `parallel` by rayon, otherwise files are read by threads of the
//! standard library, and all else is done by one. The bank is the same.

#[cfg(feature = "parallel")]
pub(crate) use with_rayon::{for_each, in_pool, join, map_init, sort, workers};
#[cfg(not(feature = "parallel"))]
pub(crate) use without_rayon::{for_each, in_pool, join, map_init, sort, workers};

#[cfg(feature = "parallel")]
mod with_rayon {
    use rayon::prelude::*;

    /// Runs `work` with this number of threads; on the current ones if no others can be started.
    pub(crate) fn in_pool<R: Send>(threads: Option<usize>, work: impl FnOnce() -> R + Send) -> R {
        let pool = threads.map(|count| rayon::ThreadPoolBuilder::new().num_threads(count).build());
        match pool {
            Some(Ok(pool)) => pool.install(work),
            Some(Err(_)) | None => work(),
        }
    }

    /// Runs `work` on each thread; `threads` is that of the pool.
    pub(crate) fn workers<R: Send>(_threads: Option<usize>, work: impl Fn() -> R + Send + Sync) -> Vec<R> {
        (0..rayon::current_num_threads()).into_par_iter().with_max_len(1).map(|_| work()).collect()
    }

    pub(crate) fn join<A: Send, B: Send>(a: impl FnOnce() -> A + Send, b: impl FnOnce() -> B + Send) -> (A, B) {
        rayon::join(a, b)
    }

    pub(crate) fn for_each<T: Send>(items: Vec<T>, work: impl Fn(T) + Send + Sync) {
        items.into_par_iter().for_each(work);
    }

    /// The results of `work` in the order of the items; each thread has a state of its own.
    pub(crate) fn map_init<T: Sync, S, C: FromParallelIterator<R>, R: Send>(
        items: &[T],
        init: impl Fn() -> S + Send + Sync,
        work: impl Fn(&mut S, &T) -> R + Send + Sync,
    ) -> C {
        items.par_iter().map_init(init, work).collect()
    }

    pub(crate) fn sort(items: &mut [u64]) {
        items.par_sort_unstable();
    }
}

#[cfg(not(feature = "parallel"))]
mod without_rayon {
    use std::num::NonZero;
    use std::thread;

    /// Runs `work`.
    pub(crate) fn in_pool<R: Send>(_threads: Option<usize>, work: impl FnOnce() -> R + Send) -> R {
        work()
    }

    /// Runs `work` on this number of threads, or as many as the machine has.
    pub(crate) fn workers<R: Send>(threads: Option<usize>, work: impl Fn() -> R + Send + Sync) -> Vec<R> {
        let count = threads.unwrap_or_else(|| thread::available_parallelism().map_or(1, NonZero::get));
        thread::scope(|scope| {
            let others: Vec<_> =
                (1..count).map_while(|_| thread::Builder::new().spawn_scoped(scope, &work).ok()).collect();
            let mut results = vec![work()];
            for other in others {
                match other.join() {
                    Ok(result) => results.push(result),
                    Err(panic) => std::panic::resume_unwind(panic),
                }
            }
            results
        })
    }

    pub(crate) fn join<A: Send, B: Send>(a: impl FnOnce() -> A + Send, b: impl FnOnce() -> B + Send) -> (A, B) {
        (a(), b())
    }

    pub(crate) fn for_each<T: Send>(items: Vec<T>, work: impl Fn(T) + Send + Sync) {
        items.into_iter().for_each(work);
    }

    /// The results of `work` in the order of the items.
    pub(crate) fn map_init<T: Sync, S, C: FromIterator<R>, R: Send>(
        items: &[T],
        init: impl Fn() -> S + Send + Sync,
        work: impl Fn(&mut S, &T) -> R + Send + Sync,
    ) -> C {
        let mut state = init();
        items.iter().map(|item| work(&mut state, item)).collect()
    }

    pub(crate) fn sort(items: &mut [u64]) {
        items.sort_unstable();
    }
}
