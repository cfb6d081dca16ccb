//! The end of a run that writes the bank to a file.

use super::next::NextStep;
use super::old_bank::OldBank;
use super::recall::checksum_of;
use super::stamped_run::{FinishedRun, StampedRun, read_all, touch};
use super::task::Task;
use crate::files::output::failed;
use crate::files::{OutputFile, Replace};
use crate::run::Compiler;
use lipz_diagnostics::Report;
use std::path::Path;

/// The destination of a bank, and the condition for writing it.
pub(super) struct BankTarget<'p> {
    pub(super) path: &'p Path,
    pub(super) replace: Replace,
}

/// Ends a run. Memory allocated for the bank is kept in `room`.
pub(super) fn end(
    compiler: &Compiler<'_>,
    task: &Task<'_>,
    next: NextStep,
    place: &BankTarget<'_>,
    room: &mut Vec<u8>,
) -> FinishedRun<OutputFile> {
    let BankTarget { path, replace } = *place;
    match next {
        NextStep::Nothing(run) => run.done(task, |run| run.finish(None)),
        NextStep::Stay(run, old, are_stamps_unchanged) if old.is_proven() && old.is_as_it_was() => {
            run.stays(task, (old.tables(), are_stamps_unchanged), || stay(compiler, &old, place))
        }
        // The old bank is damaged, or has been modified in the meantime.
        NextStep::Stay(..) => make(compiler, task, read_all(task), place),
        NextStep::Patch(run, bank) => run.done(task, |run| {
            let mut is_new = true;
            let packed = run.conclude(Ok(bank), task.options, |bank| {
                is_new = replace.is_due(path, bank);
                // The copied data was verified before the old bank was written.
                if is_new { compiler.write_checked_bytes(path, bank, || Ok(())) } else { Ok(()) }
            });
            packed.map(|bank| {
                let file = OutputFile { is_new, ..OutputFile::new(path, bank.len()) };
                let checksum = checksum_of(&bank).unwrap_or_default();
                *room = bank;
                (file, checksum)
            })
        }),
        NextStep::Make(run) => make(compiler, task, run, place),
    }
}

fn make(compiler: &Compiler<'_>, task: &Task<'_>, run: StampedRun, place: &BankTarget<'_>) -> FinishedRun<OutputFile> {
    run.done(task, |run| {
        let packed = compiler.write_bank_of_run(run, task.inputs, task.options, (place.path, place.replace));
        packed.map(|written| (written.file, written.checksum))
    })
}

/// Leaves the old bank in place, or copies it there.
fn stay(compiler: &Compiler<'_>, old: &OldBank, place: &BankTarget<'_>) -> Result<OutputFile, Report> {
    let BankTarget { path, replace } = *place;
    let file = OutputFile { is_new: false, ..OutputFile::new(path, old.tables().len()) };
    match (replace, old) {
        (Replace::Always, _) => {
            let Err(error) = touch(path) else { return Ok(file) };
            // A file without write permission may still be replaceable.
            let bank = old.clone().into_whole().ok_or_else(|| failed(path, &error))?;
            compiler.write_verified_bytes(path, &bank)?;
        }
        (Replace::IfDifferent, OldBank::Whole(bank)) if replace.is_due(path, bank) => {
            compiler.write_verified_bytes(path, bank)?;
        }
        (Replace::IfDifferent, _) => return Ok(file),
    }
    Ok(OutputFile { is_new: true, ..file })
}
