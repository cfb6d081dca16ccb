//! The end of a run whose bank is in memory.

use super::recall::checksum_of;
use super::{Done, Next, Origin, Task, read_all};
use crate::Compiled;
use crate::compile::Run;
use lipz_diagnostics::Report;

/// Ends a run. `finish` is handed the bank, and where it comes from; without its consent there is none.
pub(super) fn end(
    task: &Task<'_>,
    next: Next,
    finish: impl FnOnce(&[u8], Origin) -> Result<(), Report> + Send,
) -> Done {
    match next {
        Next::Nothing(run) => run.done(task, |run| run.finish(None)),
        Next::Stay(run, old, are_stamps_unchanged) => match old.into_whole() {
            Some(bank) => {
                let done = run.stays(task, (&bank, are_stamps_unchanged), || finish(&bank, Origin::Unchanged));
                Done { compiled: done.compiled.map(|()| bank), stamps: done.stamps, known: done.known }
            }
            // It is damaged, or somebody has written to it meanwhile.
            None => make(task, read_all(task), finish),
        },
        Next::Patch(run, bank) => run.done(task, |run| {
            let finish = |bank: &[u8]| finish(bank, Origin::Patched);
            with_checksum(run.conclude(Ok(bank), task.options, finish))
        }),
        Next::Make(run) => make(task, run, finish),
    }
}

fn make(task: &Task<'_>, run: Run, finish: impl FnOnce(&[u8], Origin) -> Result<(), Report> + Send) -> Done {
    run.done(task, |run| with_checksum(run.make(task.inputs, task.options, |bank| finish(bank, Origin::New))))
}

fn with_checksum(compiled: Compiled) -> Compiled<(Vec<u8>, u64)> {
    compiled.map(|bank| {
        let checksum = checksum_of(&bank).unwrap_or_default();
        (bank, checksum)
    })
}
