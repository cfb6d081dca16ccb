//! A run with the stamps of its files, and its end.

use super::cached_files::Cache;
use super::changed_inputs::PreviousInputs;
use super::file_stamps::FileStamps;
use super::recall::checksum_of;
use super::stamps::Stamps;
use super::task::Task;
use crate::run::Compiled;
use crate::run::compile::{CompileRun, TextFacts};
use lipz_diagnostics::Report;
use std::fs::File;
use std::io;
use std::path::Path;
use std::time::SystemTime;

/// A run, and the data about its files for the next one.
pub(super) struct StampedRun {
    pub(super) run: CompileRun,
    pub(super) stamps: FileStamps,
}

/// The results of a run.
pub(super) struct FinishedRun<B = Vec<u8>> {
    pub(super) compiled: Compiled<B>,
    /// The stamps of a bank's files, unless all of them are unchanged.
    pub(super) stamps: Option<Stamps>,
    /// Data for a run that examines only changed files.
    pub(super) known: Option<PreviousInputs>,
}

impl StampedRun {
    /// Reports problems of dubs, whose files the next run must read again.
    #[must_use]
    pub(super) fn compare_dubs(self, task: &Task<'_>) -> StampedRun {
        StampedRun { run: self.run.compare_dubs(task.inputs, task.options), ..self }
    }

    /// Ends the run, and keeps the data for the next one. A bank comes with its checksum.
    pub(super) fn done<B>(
        mut self,
        task: &Task<'_>,
        end: impl FnOnce(CompileRun) -> Compiled<(B, u64)>,
    ) -> FinishedRun<B> {
        let reported = std::mem::take(&mut self.run.reported_dubs);
        let mut files = std::mem::take(&mut self.stamps.files);
        files.retain(|(number, ..)| !reported.contains(number));
        let known = self.run.are_keys_fine.then(|| PreviousInputs::new(&files, task.inputs.len()));
        let compiled = end(self.run);
        let checksum = compiled.bank.as_ref().map(|(_, checksum)| *checksum);
        let stamps = checksum.map(|checksum| Stamps::new(task.options, checksum, files));
        let known = known.filter(|_| stamps.is_some());
        FinishedRun { compiled: compiled.map(|(bank, _)| bank), stamps, known }
    }

    /// Ends the run with the old bank, unless the project's requirements have changed or `end` fails.
    pub(super) fn stays<B>(
        self,
        task: &Task<'_>,
        (bank, are_stamps_unchanged): (&[u8], bool),
        end: impl FnOnce() -> Result<B, Report>,
    ) -> FinishedRun<B> {
        let texts = TextFacts::of_old(bank, task.options);
        let checksum = checksum_of(bank).unwrap_or_default();
        let mut done = self.done(task, |mut run| match run.expect(&texts, task.options).and_then(|()| end()) {
            Ok(bank) => Compiled { is_unchanged: true, ..run.finish(Some((bank, checksum))) },
            Err(report) => run.fail(report),
        });
        done.stamps = done.stamps.filter(|_| !are_stamps_unchanged);
        done
    }
}

/// Sets the modification time of the file at `path` to the current time, for build tools that compare it with the
/// sources.
pub(super) fn touch(path: &Path) -> io::Result<()> {
    File::options().append(true).open(path)?.set_modified(SystemTime::now())
}

/// Reads and stamps all files.
pub(super) fn read_all(task: &Task<'_>) -> StampedRun {
    let cache = Cache::of(None);
    let run = CompileRun::read(task.inputs, task.options, Some(&cache), &|_| ());
    StampedRun { run, stamps: cache.into_stamps() }.compare_dubs(task)
}
