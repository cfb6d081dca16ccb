//! What a program that packs again and again remembers from one run to the next.

use super::few::Known;
use super::in_file::Place;
use super::old_bank::OldBank;
use super::stamps::{MAGIC, Stamps};
use super::{Done, Origin, PreviousRun, Task, file, in_file, in_memory, next};
use crate::compile::verify;
use crate::{Compiled, Compiler, Input, OutputFile, Replace};
use lipz_diagnostics::Report;
use std::path::Path;
use std::sync::Arc;

/// What a run leaves to the next one: its bank, and what its files looked like. So the next one reads only the
/// files that changed, as with [`pack_cached`](Compiler::pack_cached), but without a file for it.
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
    before: Option<Remembered>,
    /// Room for the next bank that is patched: the system takes longer to give it than it takes to copy a bank.
    room: Vec<u8>,
}

/// A run that is remembered.
#[derive(Clone)]
struct Remembered {
    stamps: Arc<Stamps>,
    known: Option<Arc<Known>>,
    /// Its bank; `None` if that is in the file into which it was written.
    bank: Option<Arc<Vec<u8>>>,
}

impl Memory {
    /// What [`pack_cached`](Compiler::pack_cached) left in the file `cache` about the bank at `path`. Nothing, if either
    /// is missing or damaged or was made by another version of this library.
    ///
    /// # Errors
    /// If there is something else than a cache at `cache`, or it cannot be read.
    pub fn read(cache: &Path, path: &Path) -> Result<Memory, Report> {
        let before = PreviousRun::read(cache, path)?;
        let remembered = before.and_then(|PreviousRun { stamps, bank, .. }| {
            // The file may change before the next run; memory does not.
            let bank = bank.into_whole()?;
            Some(Remembered { stamps, known: None, bank: Some(bank.into()) })
        });
        Ok(Memory { before: remembered, room: Vec::new() })
    }

    /// The same for runs that write the bank into this file, where it can stay.
    pub(crate) fn read_beside(cache: &Path) -> Result<Memory, Report> {
        let stamps = file::read(cache, MAGIC)?;
        let remembered = stamps.map(|stamps| Remembered { stamps: stamps.into(), known: None, bank: None });
        Ok(Memory { before: remembered, room: Vec::new() })
    }

    /// Writes it into the file `cache`, for a later [`Memory::read`] or [`pack_cached`](Compiler::pack_cached). The bank
    /// is not written: it must be the one that the last successful run gave.
    ///
    /// # Errors
    /// If there is something else than a cache at `cache`, or it cannot be written.
    pub fn write(&self, cache: &Path) -> Result<(), Report> {
        self.before.as_ref().map_or(Ok(()), |before| file::write(cache, MAGIC, &before.stamps))
    }

    /// Whether nothing is remembered.
    pub fn is_empty(&self) -> bool {
        self.before.is_none()
    }

    /// The run before, whose bank may be in the file at `path`.
    fn previous(&self, path: Option<&Path>) -> Option<PreviousRun> {
        let Remembered { stamps, known, bank } = self.before.clone()?;
        let bank = match (bank, path) {
            (Some(whole), _) => OldBank::Whole(whole),
            (None, path) => OldBank::open(path?, stamps.bank_checksum)?,
        };
        Some(PreviousRun { stamps, bank, known })
    }

    /// Remembers a run that has made a bank; what it has no new stamps for has those of the run before. `bank` is
    /// `None` if it is in a file.
    fn remember(&mut self, done: (Option<Stamps>, Option<Known>), bank: Option<Arc<Vec<u8>>>) {
        let (stamps, known) = done;
        let known = known.map(Arc::new);
        match (stamps, self.before.as_mut()) {
            (Some(stamps), _) => self.before = Some(Remembered { stamps: stamps.into(), known, bank }),
            (None, Some(before)) => {
                before.known = known;
                // Of the same bank.
                before.bank = before.bank.take().and(bank);
            }
            (None, None) => {}
        }
    }
}

impl Compiler<'_> {
    /// Does what [`compile`](Compiler::compile) does with what `memory` has of the previous run, and remembers
    /// this one. A run without a bank leaves the memory as it is.
    pub fn compile_again(&self, inputs: &[Input], memory: &mut Memory) -> Compiled {
        self.compile_changed(inputs, None, memory)
    }

    /// The same for a program that knows which files can have `changed` since the run that `memory` remembers, by their
    /// numbers among `inputs`, which have to be those of that run: no other file is looked at. If it does not know,
    /// or `memory` has nothing of these inputs, all are.
    pub fn compile_changed(&self, inputs: &[Input], changed: Option<&[usize]>, memory: &mut Memory) -> Compiled {
        // The old bank was verified when it was made.
        let finish = |bank: &[u8], origin| if origin == Origin::New { verify(bank) } else { Ok(()) };
        self.run(|options| {
            let task = Task { inputs, options, progress: &self.progress, changed };
            let Done { compiled, stamps, known } =
                in_memory::end(&task, next(&task, memory.previous(None), &mut Vec::new()), finish);
            if let Some(bank) = &compiled.bank {
                let old = memory.before.as_ref().and_then(|before| before.bank.clone());
                let bank = old.filter(|_| stamps.is_none()).unwrap_or_else(|| Arc::new(bank.clone()));
                memory.remember((stamps, known), Some(bank));
            }
            compiled
        })
    }

    /// The same for a program that has the bank in the file at `path` and nowhere else. It is written if it is another one than
    /// the file has.
    pub(crate) fn pack_changed(
        &self,
        inputs: &[Input],
        changed: Option<&[usize]>,
        path: &Path,
        memory: &mut Memory,
    ) -> Compiled<OutputFile> {
        self.run(|options| {
            let task = Task { inputs, options, progress: &self.progress, changed };
            let place = Place { path, replace: Replace::IfDifferent };
            let next = next(&task, memory.previous(Some(path)), &mut memory.room);
            let Done { mut compiled, stamps, known } = in_file::end(self, &task, next, &place, &mut memory.room);
            if let Some(file) = &compiled.bank {
                compiled.is_unchanged = !file.is_new;
                memory.remember((stamps, known), None);
            }
            compiled
        })
    }
}
