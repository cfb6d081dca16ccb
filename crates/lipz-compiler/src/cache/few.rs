//! A run that is told which files can have changed since the one before: it looks at no other.

use super::stamps::{Lookup, Name, Stamp};
use super::{Cache, PreviousRun, Task};
use crate::Input;
use crate::compile::Run;
use std::time::SystemTime;

/// What a run has to know of the one before to look only at what changed since.
#[derive(Debug)]
pub(super) struct Known {
    input_count: usize,
    /// Numbers of the inputs without a stamp, ascending: each run reads them, because something is reported about them.
    unstamped: Vec<u32>,
}

/// The inputs that a run looks at.
pub(super) struct Few {
    /// Their numbers, ascending.
    numbers: Vec<u32>,
    inputs: Vec<Input>,
    /// The stamps that they had.
    stamps: Vec<(Name, Stamp)>,
}

impl Known {
    /// What is known after a run over so many inputs, of which these files have stamps.
    pub(super) fn new(stamped: &[(u32, Name, Stamp)], input_count: usize) -> Known {
        let mut stamped = stamped.iter().map(|(number, ..)| *number).peekable();
        let all = 0..u32::try_from(input_count).unwrap_or(u32::MAX);
        Known { input_count, unstamped: all.filter(|number| stamped.next_if_eq(number).is_none()).collect() }
    }

    /// Numbers of the inputs with a stamp, in the order of the stamps.
    fn stamped(&self) -> impl Iterator<Item = u32> {
        let mut unstamped = self.unstamped.iter().peekable();
        let all = 0..u32::try_from(self.input_count).unwrap_or(u32::MAX);
        all.filter(move |number| unstamped.next_if_eq(&number).is_none())
    }
}

impl PreviousRun {
    /// The inputs to look at where these can have changed; `None` if more has to be looked at.
    pub(super) fn few(&self, inputs: &[Input], changed: &[usize]) -> Option<Few> {
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
        Some(Few { numbers, inputs: few?, stamps })
    }
}

impl Few {
    /// Reads them, and has of all others what the run `before` left.
    pub(super) fn read(&self, task: &Task<'_>, before: &PreviousRun) -> Run {
        let cache = Cache { before: Some(Lookup::new(&self.stamps)), start: SystemTime::now() };
        let mut run = Run::read(&self.inputs, task.options, Some(&cache), task.progress);
        let read = std::mem::take(&mut run.stamped);
        let number = |index: u32| self.numbers.get(index as usize).copied();
        let is_read = |number: &u32| self.numbers.binary_search(number).is_ok();
        let all = 0..u32::try_from(task.inputs.len()).unwrap_or(u32::MAX);
        let known = before.known.iter().flat_map(|known| known.stamped()).zip(before.stamps.files());
        let kept = known.filter(|(number, _)| !is_read(number)).map(|(number, (name, stamp))| (number, *name, *stamp));
        run.stamped.files.extend(kept);
        let new = read.files.into_iter().filter_map(|(index, name, stamp)| Some((number(index)?, name, stamp)));
        run.stamped.files.extend(new);
        run.stamped.sort();
        run.stamped.recalled.extend(all.filter(|number| !is_read(number)));
        run.stamped.unread = run.stamped.recalled.len() + read.unread;
        run.stamped.recalled.extend(read.recalled.into_iter().filter_map(number));
        run
    }
}
