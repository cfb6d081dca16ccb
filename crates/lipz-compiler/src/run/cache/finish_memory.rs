//! The end of a run whose bank stays in memory.

use super::next::NextStep;
use super::recall::checksum_of;
use super::stamped_run::{FinishedRun, StampedRun, read_all};
use super::task::{BankOrigin, Task};
use crate::run::Compiled;
use lipz_diagnostics::Report;

/// Ends a run. `finish` receives the bank and its origin. If it fails, there is no bank.
pub(super) fn end(
    task: &Task<'_>,
    next: NextStep,
    finish: impl FnOnce(&[u8], BankOrigin) -> Result<(), Report> + Send,
) -> FinishedRun {
    match next {
        NextStep::Nothing(run) => run.done(task, |run| run.finish(None)),
        NextStep::Stay(run, old, are_stamps_unchanged) => match old.into_whole() {
            Some(bank) => {
                let done = run.stays(task, (&bank, are_stamps_unchanged), || finish(&bank, BankOrigin::Unchanged));
                FinishedRun { compiled: done.compiled.map(|()| bank), stamps: done.stamps, known: done.known }
            }
            // The old bank is damaged, or has been modified in the meantime.
            None => make(task, read_all(task), finish),
        },
        NextStep::Patch(run, bank) => run.done(task, |run| {
            let finish = |bank: &[u8]| finish(bank, BankOrigin::Patched);
            with_checksum(run.conclude(Ok(bank), task.options, finish))
        }),
        NextStep::Make(run) => make(task, run, finish),
    }
}

fn make(
    task: &Task<'_>,
    run: StampedRun,
    finish: impl FnOnce(&[u8], BankOrigin) -> Result<(), Report> + Send,
) -> FinishedRun {
    run.done(task, |run| with_checksum(run.make(task.inputs, task.options, |bank| finish(bank, BankOrigin::New))))
}

fn with_checksum(compiled: Compiled) -> Compiled<(Vec<u8>, u64)> {
    compiled.map(|bank| {
        let checksum = checksum_of(&bank).unwrap_or_default();
        (bank, checksum)
    })
}
