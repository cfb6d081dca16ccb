//! What a program that packs again and again remembers from one run to the next.

use super::old_bank::OldBank;
use super::{Origin, PreviousRun, again, file};
use crate::compile::verify;
use crate::{Compiled, Compiler, Input};
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
/// let (inputs, _) = discover(&[voices.into()], None);
/// let compiler = Compiler::default();
/// let first = compiler.compile_again(&inputs, &mut memory);
/// let second = compiler.compile_again(&inputs, &mut memory);
/// assert_eq!((first.recalled, second.recalled, second.is_unchanged), (0, 1, true));
/// assert_eq!(first.bank, second.bank);
/// # Ok::<(), std::io::Error>(())
/// ```
#[derive(Clone, Default)]
pub struct Memory(Option<PreviousRun>);

impl Memory {
    /// What [`pack_cached`](Compiler::pack_cached) left in the file `cache` about the bank at `path`. Nothing, if either
    /// is missing or damaged or was made by another version of this library.
    ///
    /// # Errors
    /// If there is something else than a cache at `cache`, or it cannot be read.
    pub fn read(cache: &Path, path: &Path) -> Result<Memory, Report> {
        let before = PreviousRun::read(cache, path)?;
        Ok(Memory(before.and_then(|PreviousRun { stamps, bank }| {
            // The file may change before the next run; memory does not.
            let bank = OldBank::Whole(bank.into_whole()?.into());
            Some(PreviousRun { stamps, bank })
        })))
    }

    /// Writes it into the file `cache`, for a later [`Memory::read`] or [`pack_cached`](Compiler::pack_cached). The bank
    /// is not written: it must be the one that the last successful run gave.
    ///
    /// # Errors
    /// If there is something else than a cache at `cache`, or it cannot be written.
    pub fn write(&self, cache: &Path) -> Result<(), Report> {
        self.0.as_ref().map_or(Ok(()), |before| file::write(cache, &before.stamps))
    }

    /// Whether nothing is remembered.
    pub fn is_empty(&self) -> bool {
        self.0.is_none()
    }
}

impl Compiler<'_> {
    /// Does what [`compile`](Compiler::compile) does with what `memory` has of the previous run, and remembers
    /// this one. A run without a bank leaves the memory as it is.
    pub fn compile_again(&self, inputs: &[Input], memory: &mut Memory) -> Compiled {
        // The old bank was verified when it was made.
        let finish = |bank: &[u8], origin| if origin == Origin::New { verify(bank) } else { Ok(()) };
        self.run(|options| {
            let (compiled, stamps) = again(inputs, options, memory.0.clone(), &self.progress, finish);
            if let (Some(bank), Some(stamps)) = (&compiled.bank, stamps) {
                memory.0 = Some(PreviousRun { stamps: stamps.into(), bank: OldBank::Whole(Arc::new(bank.clone())) });
            }
            compiled
        })
    }
}
