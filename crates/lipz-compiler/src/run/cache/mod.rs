//! Packing again after few files have changed: unchanged clips are recalled from the old bank.
//!
//! The bank already contains all clips. The cache file contains the proof that they match the files: the metadata of
//! each file, the hash of its contents, and the checksum of the bank. Nothing is used without proof, so that the new
//! bank equals that of a run without a cache. `docs/inside/packing.md` describes the proofs.

mod cached_files;
mod changed_inputs;
mod check;
mod file;
mod file_stamps;
mod finish_file;
mod finish_memory;
mod memory;
mod next;
mod old_bank;
mod patch;
mod previous_run;
mod recall;
mod recall_all;
mod scratch;
mod stamped_run;
mod stamps;
mod survey;
mod task;

pub use memory::Memory;
#[cfg(feature = "shards")]
pub(crate) use old_bank::section;
#[cfg(feature = "shards")]
pub(crate) use recall::{are_in_order, recall_tables};

use crate::files::path::display;
use crate::files::{OutputFile, Replace};
use crate::run::{Compiled, Compiler};
use crate::sources::Input;
use finish_file::BankTarget;
#[cfg(feature = "build")]
use lipz_diagnostics::Report;
use next::{NextStep, next};
use previous_run::PreviousRun;
use stamped_run::FinishedRun;
use stamps::MAGIC;
use std::path::Path;
use std::time::Instant;
#[cfg(feature = "build")]
use task::BankOrigin;
use task::Task;

impl Compiler<'_> {
    /// Packs like [`pack`](Compiler::pack), and stores data about the files in the file `cache`, so that the next run
    /// reads only changed files. The clips of all others are recalled from the bank at `path`. The bank is the same,
    /// byte for byte, as that of [`pack`](Compiler::pack).
    ///
    /// Files with diagnostics are read in every run, so that the diagnostics are reported again. If no clip has
    /// changed, the bank stays and its modification time is set to the current time.
    ///
    /// The cache is safe to delete. A cache that is damaged, or belongs to a different version of this library, a
    /// different bank or different options, is ignored and replaced. A file that is not a cache is left alone and
    /// reported, as is one that cannot be written.
    pub fn pack_cached(&self, inputs: &[Input], path: &Path, cache: &Path) -> Compiled<OutputFile> {
        let place = BankTarget { path, replace: Replace::Always };
        let mut packed =
            self.cached(inputs, path, cache, |task, next| finish_file::end(self, task, next, &place, &mut Vec::new()));
        packed.is_unchanged &= packed.bank.as_ref().is_some_and(|file| !file.is_new);
        packed
    }

    /// Packs into memory first, and writes the bank only if `accept` succeeds.
    #[cfg(feature = "build")]
    pub(crate) fn pack_cached_if(
        &self,
        inputs: &[Input],
        path: &Path,
        cache: &Path,
        accept: impl FnOnce(&[u8]) -> Result<(), Report> + Send,
    ) -> Compiled {
        let finish = |bank: &[u8], origin: BankOrigin| {
            accept(bank)?;
            match origin {
                BankOrigin::Unchanged if stamped_run::touch(path).is_ok() => Ok(()),
                BankOrigin::Patched => self.write_checked_bytes(path, bank, || Ok(())),
                _ => self.write_verified_bytes(path, bank),
            }
        };
        self.cached(inputs, path, cache, |task, next| finish_memory::end(task, next, finish))
    }

    /// Packs with the data in the file `cache`, and writes that file again.
    fn cached<B: Send>(
        &self,
        inputs: &[Input],
        path: &Path,
        cache: &Path,
        end: impl FnOnce(&Task<'_>, NextStep) -> FinishedRun<B> + Send,
    ) -> Compiled<B> {
        self.compile_in_pool(|options| {
            let start = Instant::now();
            let before = match PreviousRun::read(cache, path) {
                Ok(before) => before,
                Err(report) => return Compiled::refused(report),
            };
            let reading = start.elapsed();
            let task = Task { inputs, options, progress: &self.progress, changed: None };
            let FinishedRun { compiled, stamps, .. } = end(&task, next(&task, before, &mut Vec::new()));
            let start = Instant::now();
            let written = stamps.and_then(|stamps| self.call_guarded(|| file::write(cache, MAGIC, &stamps)));
            let mut compiled = compiled.and_then(|bank| match written {
                Some(Err(mut report)) => {
                    let note = format!("the bank `{}` was written and is up to date", display(path));
                    report.diagnostics.iter_mut().for_each(|diagnostic| diagnostic.notes.push(note.clone()));
                    Err(report)
                }
                _ => Ok(bank),
            });
            compiled.phases.cache += reading + start.elapsed();
            compiled
        })
    }
}
