//! Work on several threads: with the feature `parallel`, on those of rayon; otherwise, threads of the standard library
//! read files, and a single thread does everything else. The bank is the same.

#[cfg(feature = "parallel")]
pub(crate) use with_rayon::{for_each, in_pool, join, map_init, sort, thread_count, workers};
#[cfg(not(feature = "parallel"))]
pub(crate) use without_rayon::{for_each, in_pool, join, map_init, sort, thread_count, workers};

#[cfg(feature = "parallel")]
mod with_rayon {
    use rayon::ThreadPoolBuilder;
    use rayon::prelude::*;
    use std::num::NonZero;
    use std::thread;

    /// Runs `work` with this number of threads, or one per core; with fewer if the system does not provide that many,
    /// as in a container with a limit. The functions below use these threads, and a single one outside of `in_pool`.
    pub(crate) fn in_pool<R: Send>(threads: Option<usize>, work: impl FnOnce() -> R + Send) -> R {
        let wanted = threads.unwrap_or_else(|| thread::available_parallelism().map_or(1, NonZero::get));
        let fewer = std::iter::successors(Some(wanted.max(1)), |count| (*count > 1).then_some(count / 2));
        for count in fewer {
            if let Ok(pool) = ThreadPoolBuilder::new().num_threads(count).build() {
                return pool.install(work);
            }
        }
        work()
    }

    /// Whether there are threads to share work. Querying rayon's own pool would panic if there are none.
    fn is_in_pool() -> bool {
        rayon::current_thread_index().is_some()
    }

    /// Returns the number of threads that share work.
    pub(crate) fn thread_count() -> usize {
        if is_in_pool() { rayon::current_num_threads() } else { 1 }
    }

    /// Runs `work` on each thread; `threads` is the number in the pool.
    pub(crate) fn workers<R: Send>(_threads: Option<usize>, work: impl Fn() -> R + Send + Sync) -> Vec<R> {
        if !is_in_pool() {
            return vec![work()];
        }
        (0..rayon::current_num_threads()).into_par_iter().with_max_len(1).map(|_| work()).collect()
    }

    pub(crate) fn join<A: Send, B: Send>(a: impl FnOnce() -> A + Send, b: impl FnOnce() -> B + Send) -> (A, B) {
        if is_in_pool() { rayon::join(a, b) } else { (a(), b()) }
    }

    pub(crate) fn for_each<T: Send>(items: Vec<T>, work: impl Fn(T) + Send + Sync) {
        if is_in_pool() { items.into_par_iter().for_each(work) } else { items.into_iter().for_each(work) }
    }

    /// Returns the results of `work` in the order of the items. Each thread has its own state.
    pub(crate) fn map_init<T, S, C, R>(
        items: &[T],
        init: impl Fn() -> S + Send + Sync,
        work: impl Fn(&mut S, &T) -> R + Send + Sync,
    ) -> C
    where
        T: Sync,
        C: FromParallelIterator<R> + FromIterator<R>,
        R: Send,
    {
        if !is_in_pool() {
            let mut state = init();
            return items.iter().map(|item| work(&mut state, item)).collect();
        }
        items.par_iter().map_init(init, work).collect()
    }

    pub(crate) fn sort(items: &mut [u64]) {
        if is_in_pool() { items.par_sort_unstable() } else { items.sort_unstable() }
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

    /// Returns the number of threads that share work.
    pub(crate) fn thread_count() -> usize {
        1
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

    /// Returns the results of `work` in the order of the items.
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
