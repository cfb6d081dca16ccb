//! A run that reads only those files that may have changed since the previous run.

use super::cached_files::Cache;
use super::file_stamps::FileStamps;
use super::previous_run::PreviousRun;
use super::stamped_run::StampedRun;
use super::stamps::{CacheFileName, Lookup, Stamp};
use super::task::Task;
use crate::run::compile::CompileRun;
use crate::sources::Input;

/// The data of the previous run that allows examining only changed files.
#[derive(Debug)]
pub(super) struct PreviousInputs {
    input_count: usize,
    /// Numbers of the inputs without a stamp, ascending. Each run reads them, because they have diagnostics.
    unstamped: Vec<u32>,
}

/// The inputs that a run examines.
pub(super) struct ChangedInputs {
    /// Their numbers, ascending.
    numbers: Vec<u32>,
    inputs: Vec<Input>,
    /// Their previous stamps.
    stamps: Vec<(CacheFileName, Stamp)>,
}

impl PreviousInputs {
    /// Creates the data after a run over this number of inputs, of which these files have stamps.
    pub(super) fn new(stamped: &[(u32, CacheFileName, Stamp)], input_count: usize) -> PreviousInputs {
        let mut stamped = stamped.iter().map(|(number, ..)| *number).peekable();
        let all = 0..u32::try_from(input_count).unwrap_or(u32::MAX);
        PreviousInputs { input_count, unstamped: all.filter(|number| stamped.next_if_eq(number).is_none()).collect() }
    }

    /// Returns the numbers of the inputs with a stamp, in the order of the stamps.
    fn stamped(&self) -> impl Iterator<Item = u32> {
        let mut unstamped = self.unstamped.iter().peekable();
        let all = 0..u32::try_from(self.input_count).unwrap_or(u32::MAX);
        all.filter(move |number| unstamped.next_if_eq(&number).is_none())
    }
}

impl PreviousRun {
    /// Returns the inputs to examine if these may have changed; `None` if all of them must be examined.
    pub(super) fn few(&self, inputs: &[Input], changed: &[usize]) -> Option<ChangedInputs> {
        let known = self.known.as_ref().filter(|known| known.input_count == inputs.len())?;
        self.bank.clip_count().filter(|count| *count == inputs.len())?;
        let changed = changed.iter().map(|number| u32::try_from(*number).ok());
        let mut numbers: Vec<u32> = changed.collect::<Option<_>>()?;
        numbers.extend_from_slice(&known.unstamped);
        numbers.sort_unstable();
        numbers.dedup();
        let few: Option<Vec<Input>> = numbers.iter().map(|number| inputs.get(*number as usize).cloned()).collect();
        let mut wanted = numbers.iter().copied().peekable();
        let mut stamps = Vec::with_capacity(numbers.len());
        for (number, stamp) in known.stamped().zip(self.stamps.files()) {
            while wanted.next_if(|wanted| *wanted < number).is_some() {}
            if wanted.next_if_eq(&number).is_some() {
                stamps.push(*stamp);
            }
        }
        Some(ChangedInputs { numbers, inputs: few?, stamps })
    }
}

impl ChangedInputs {
    /// Reads them, and takes everything else from the run `before`.
    pub(super) fn read(&self, task: &Task<'_>, before: &PreviousRun) -> StampedRun {
        let cache = Cache::of(Some(Lookup::new(&self.stamps)));
        let mut run = CompileRun::read(&self.inputs, task.options, Some(&cache), task.progress);
        let read = cache.into_stamps();
        let mut stamps = FileStamps::default();
        let number = |index: u32| self.numbers.get(index as usize).copied();
        let is_read = |number: &u32| self.numbers.binary_search(number).is_ok();
        let all = 0..u32::try_from(task.inputs.len()).unwrap_or(u32::MAX);
        let known = before.known.iter().flat_map(|known| known.stamped()).zip(before.stamps.files());
        let kept = known.filter(|(number, _)| !is_read(number)).map(|(number, (name, stamp))| (number, *name, *stamp));
        stamps.files.extend(kept);
        let new = read.files.into_iter().filter_map(|(index, name, stamp)| Some((number(index)?, name, stamp)));
        stamps.files.extend(new);
        stamps.sort();
        stamps.recalled.extend(all.filter(|number| !is_read(number)));
        stamps.unread = stamps.recalled.len() + read.unread;
        stamps.recalled.extend(read.recalled.into_iter().filter_map(number));
        run.recalled = stamps.recalled.len();
        StampedRun { run, stamps }
    }
}
