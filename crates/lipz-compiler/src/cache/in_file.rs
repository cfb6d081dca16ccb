//! The end of a run whose bank goes to a file.

use super::old_bank::OldBank;
use super::recall::checksum_of;
use super::{Done, Next, Task, read_all, touch};
use crate::compile::Run;
use crate::output::failed;
use crate::{Compiler, OutputFile, Replace};
use lipz_diagnostics::Report;
use std::path::Path;

/// Where a bank goes, and when it is written.
pub(super) struct Place<'p> {
    pub(super) path: &'p Path,
    pub(super) replace: Replace,
}

/// Ends a run. Memory that was taken for the bank is left in `room`.
pub(super) fn end(
    compiler: &Compiler<'_>,
    task: &Task<'_>,
    next: Next,
    place: &Place<'_>,
    room: &mut Vec<u8>,
) -> Done<OutputFile> {
    let Place { path, replace } = *place;
    match next {
        Next::Nothing(run) => run.done(task, |run| run.finish(None)),
        Next::Stay(run, old, are_stamps_unchanged) if old.is_proven() && old.is_as_it_was() => {
            run.stays(task, (old.tables(), are_stamps_unchanged), || stay(compiler, &old, place))
        }
        // It is damaged, or somebody has written to it meanwhile.
        Next::Stay(..) => make(compiler, task, read_all(task), place),
        Next::Patch(run, bank) => run.done(task, |run| {
            let mut is_new = true;
            let packed = run.conclude(Ok(bank), task.options, |bank| {
                is_new = replace.is_due(path, bank);
                // What is copied was verified before the old bank was written.
                if is_new { compiler.write_if(path, bank, || Ok(())) } else { Ok(()) }
            });
            packed.map(|bank| {
                let file = OutputFile { is_new, ..OutputFile::new(path, bank.len()) };
                let checksum = checksum_of(&bank).unwrap_or_default();
                *room = bank;
                (file, checksum)
            })
        }),
        Next::Make(run) => make(compiler, task, run, place),
    }
}

fn make(compiler: &Compiler<'_>, task: &Task<'_>, run: Run, place: &Place<'_>) -> Done<OutputFile> {
    run.done(task, |run| {
        let packed = compiler.write_run(run, task.inputs, task.options, (place.path, place.replace));
        packed.map(|written| (written.file, written.checksum))
    })
}

/// Leaves the old bank where it is, or brings it there.
fn stay(compiler: &Compiler<'_>, old: &OldBank, place: &Place<'_>) -> Result<OutputFile, Report> {
    let Place { path, replace } = *place;
    let file = OutputFile { is_new: false, ..OutputFile::new(path, old.tables().len()) };
    match (replace, old) {
        (Replace::Always, _) => {
            let Err(error) = touch(path) else { return Ok(file) };
            // Who may not write to a file may be allowed to replace it.
            let bank = old.clone().into_whole().ok_or_else(|| failed(path, &error))?;
            compiler.write_verified(path, &bank)?;
        }
        (Replace::IfDifferent, OldBank::Whole(bank)) if replace.is_due(path, bank) => {
            compiler.write_verified(path, bank)?;
        }
        (Replace::IfDifferent, _) => return Ok(file),
    }
    Ok(OutputFile { is_new: true, ..file })
}
