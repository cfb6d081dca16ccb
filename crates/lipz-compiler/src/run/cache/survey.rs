//! Examining the files of a run, and the consequences for the old bank.

use super::cached_files::Cache;
use super::previous_run::PreviousRun;
use super::stamped_run::StampedRun;
use super::task::Task;
use crate::run::compile::CompileRun;
use std::time::Instant;

/// A run that has examined files, and the consequences for the old bank.
pub(super) struct Survey {
    pub(super) stamped: StampedRun,
    /// The number of clips found in the old bank.
    pub(super) found: usize,
    /// Whether the old bank is the bank of exactly these files.
    pub(super) is_unchanged: bool,
    /// Whether the stamps are unchanged as well.
    pub(super) are_stamps_unchanged: bool,
    /// Whether the old bank has the same keys.
    pub(super) has_same_keys: bool,
}

impl Survey {
    /// Examines the files that may have changed since the run `before`.
    pub(super) fn at(task: &Task<'_>, before: Option<&PreviousRun>) -> Survey {
        let start = Instant::now();
        let Task { inputs, options, progress, changed } = task;
        let clip_count = before.and_then(|before| before.bank.clip_count());
        let few = before.zip(*changed).and_then(|(before, changed)| Some((before, before.few(inputs, changed)?)));
        let run = match few {
            Some((before, few)) => few.read(task, before),
            None => {
                let cache = Cache::new(before.map(|before| &*before.stamps), before.map(|before| &before.bank));
                let recalling = start.elapsed();
                let mut run = CompileRun::read(inputs, options, Some(&cache), progress);
                run.phases.cache = recalling;
                StampedRun { run, stamps: cache.into_stamps() }
            }
        };
        let found = run.stamps.recalled.len();
        let stamp_count = before.map_or(0, |before| before.stamps.count());
        let is_unchanged = found == inputs.len() && clip_count == Some(found);
        Survey {
            found,
            is_unchanged,
            are_stamps_unchanged: is_unchanged && run.stamps.unread == found && stamp_count == found,
            has_same_keys: clip_count == Some(inputs.len()) && found + run.run.clip_count() == inputs.len(),
            stamped: run,
        }
    }
}
