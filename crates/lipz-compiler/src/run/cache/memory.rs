//! Results kept from one run to the next, by a program that packs repeatedly.

use super::changed_inputs::PreviousInputs;
use super::finish_file::BankTarget;
use super::next::next;
use super::old_bank::OldBank;
use super::previous_run::PreviousRun;
use super::stamped_run::FinishedRun;
use super::stamps::{MAGIC, Stamps};
use super::task::{BankOrigin, Task};
use super::{file, finish_file, finish_memory};
use crate::bank::verify::verify;
use crate::files::{OutputFile, Replace};
use crate::run::{Compiled, Compiler};
use crate::sources::Input;
use lipz_diagnostics::Report;
use std::path::Path;
use std::sync::Arc;

/// The results of a run for the next one: its bank, and the state of its files. The next run reads only changed files,
/// as with [`pack_cached`](Compiler::pack_cached), but without a cache file.
///
/// ```
/// use lipz_compiler::{Compiler, Memory, discover};
/// let mut memory = Memory::default();
/// # let folder = tempfile::tempdir()?;
/// # let voices = folder.path();
/// # std::fs::write(voices.join("mayor.lipz"), r#"{ "fps": 24, "visemes": "MAEO-", "viseme_type": "blair" }"#)?;
/// let inputs = discover(&[voices.into()], None)?;
/// let compiler = Compiler::default();
/// let first = compiler.compile_again(&inputs, &mut memory);
/// let second = compiler.compile_again(&inputs, &mut memory);
/// assert_eq!((first.recalled, second.recalled, second.is_unchanged), (0, 1, true));
/// assert_eq!(first.bank, second.bank);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Default)]
pub struct Memory {
    before: Option<RememberedRun>,
    /// A buffer for the next patched bank, because allocating it takes longer than copying a bank.
    room: Vec<u8>,
}

/// A remembered run.
#[derive(Clone)]
struct RememberedRun {
    stamps: Arc<Stamps>,
    known: Option<Arc<PreviousInputs>>,
    /// Its bank; `None` if the bank is in the file to which it was written.
    bank: Option<Arc<Vec<u8>>>,
}

impl Memory {
    /// Reads the data that [`pack_cached`](Compiler::pack_cached) stored in the file `cache` about the bank at `path`.
    /// The memory is empty if either is missing, damaged or from a different version of this library.
    ///
    /// # Errors
    /// If `cache` is a file of a different kind, or cannot be read.
    pub fn read(cache: &Path, path: &Path) -> Result<Memory, Report> {
        let before = PreviousRun::read(cache, path)?;
        let remembered = before.and_then(|PreviousRun { stamps, bank, .. }| {
            // The file may change before the next run, unlike memory.
            let bank = bank.into_whole()?;
            Some(RememberedRun { stamps, known: None, bank: Some(bank.into()) })
        });
        Ok(Memory { before: remembered, room: Vec::new() })
    }

    /// Reads the same for runs that write the bank into this file, without loading it.
    pub(crate) fn read_beside(cache: &Path) -> Result<Memory, Report> {
        let stamps = file::read(cache, MAGIC)?;
        let remembered = stamps.map(|stamps| RememberedRun { stamps: stamps.into(), known: None, bank: None });
        Ok(Memory { before: remembered, room: Vec::new() })
    }

    /// Writes it to the file `cache`, for a later [`Memory::read`] or [`pack_cached`](Compiler::pack_cached). The bank
    /// is not written: it must be the one that the last successful run returned.
    ///
    /// # Errors
    /// If `cache` is a file of a different kind, or cannot be written.
    pub fn write(&self, cache: &Path) -> Result<(), Report> {
        self.before.as_ref().map_or(Ok(()), |before| file::write(cache, MAGIC, &before.stamps))
    }

    /// Whether the memory is empty.
    pub fn is_empty(&self) -> bool {
        self.before.is_none()
    }

    /// Returns the previous run, whose bank may be in the file at `path`.
    fn previous(&self, path: Option<&Path>) -> Option<PreviousRun> {
        let RememberedRun { stamps, known, bank } = self.before.clone()?;
        let bank = match (bank, path) {
            (Some(whole), _) => OldBank::Whole(whole),
            (None, path) => OldBank::open(path?, stamps.bank_checksum)?,
        };
        Some(PreviousRun { stamps, bank, known })
    }

    /// Remembers a run that has made a bank. Stamps that it did not renew are taken from the previous run. `bank` is
    /// `None` if it is in a file.
    fn remember(&mut self, done: (Option<Stamps>, Option<PreviousInputs>), bank: Option<Arc<Vec<u8>>>) {
        let (stamps, known) = done;
        let known = known.map(Arc::new);
        match (stamps, self.before.as_mut()) {
            (Some(stamps), _) => self.before = Some(RememberedRun { stamps: stamps.into(), known, bank }),
            (None, Some(before)) => {
                before.known = known;
                // The stamps belong to the same bank.
                before.bank = before.bank.take().and(bank);
            }
            (None, None) => {}
        }
    }
}

impl Compiler<'_> {
    /// Compiles like [`compile`](Compiler::compile), using the previous run from `memory`, and remembers this one. A
    /// run without a bank leaves the memory unchanged.
    pub fn compile_again(&self, inputs: &[Input], memory: &mut Memory) -> Compiled {
        self.compile_changed(inputs, None, memory)
    }

    /// Compiles for a program that can tell which files may have `changed` since the run in `memory`, by their numbers
    /// among `inputs`, which must be those of that run. No other file is examined. If `changed` is `None`, or `memory`
    /// has no data about these inputs, all files are examined.
    pub fn compile_changed(&self, inputs: &[Input], changed: Option<&[usize]>, memory: &mut Memory) -> Compiled {
        // The old bank was verified when it was made.
        let finish = |bank: &[u8], origin| if origin == BankOrigin::New { verify(bank) } else { Ok(()) };
        self.compile_in_pool(|options| {
            let task = Task { inputs, options, progress: &self.progress, changed };
            let FinishedRun { compiled, stamps, known } =
                finish_memory::end(&task, next(&task, memory.previous(None), &mut Vec::new()), finish);
            if let Some(bank) = &compiled.bank {
                let old = memory.before.as_ref().and_then(|before| before.bank.clone());
                let bank = old.filter(|_| stamps.is_none()).unwrap_or_else(|| Arc::new(bank.clone()));
                memory.remember((stamps, known), Some(bank));
            }
            compiled
        })
    }

    /// Compiles for a program that keeps the bank only in the file at `path`. It is written only if it differs from the
    /// file.
    pub(crate) fn pack_changed(
        &self,
        inputs: &[Input],
        changed: Option<&[usize]>,
        path: &Path,
        memory: &mut Memory,
    ) -> Compiled<OutputFile> {
        self.compile_in_pool(|options| {
            let task = Task { inputs, options, progress: &self.progress, changed };
            let place = BankTarget { path, replace: Replace::IfDifferent };
            let next = next(&task, memory.previous(Some(path)), &mut memory.room);
            let FinishedRun { mut compiled, stamps, known } =
                finish_file::end(self, &task, next, &place, &mut memory.room);
            if let Some(file) = &compiled.bank {
                compiled.is_unchanged = !file.is_new;
                memory.remember((stamps, known), None);
            }
            compiled
        })
    }
}
