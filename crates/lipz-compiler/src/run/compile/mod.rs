//! The compiler: reads, parses and checks every file in parallel, then localises, lowers and verifies.

mod check_result;
mod compiled;
mod earlier_run;
mod file;
mod lint;
mod requirements;
mod run;

pub use check_result::CheckResult;
pub use compiled::{CompileError, Compiled, Phases};
#[cfg(feature = "cache")]
pub(crate) use earlier_run::{EarlierFiles, EarlierRun, RecalledClip};
pub use lint::{Lint, LintResult};
#[cfg(feature = "cache")]
pub(crate) use requirements::TextFacts;
pub(crate) use run::in_file;
pub(crate) use run::{Check, CompileRun};

use crate::bank::lower::Layout;
use crate::bank::lower::stream::{WriteFault, stream};
use crate::bank::verify::verify;
use crate::clip::Clips;
#[cfg(any(feature = "build", feature = "cache"))]
use crate::files::output::replace_file_if;
use crate::files::output::replace_file_with;
use crate::files::path::display;
use crate::files::{OutputFile, Replace};
use crate::project::Options;
use crate::sources::Input;
use crate::util::parallel;
use lipz_diagnostics::{Code, Report};
use std::fmt;
use std::fs::File;
use std::path::Path;

/// Checks Lipz files and packs them into banks, with the options of a project.
///
/// The bytes of a bank depend only on keys, contents and options: not on the order of the inputs, their folder, or the
/// number of threads.
///
/// ```
/// use lipz_compiler::{Compiler, Input, Options};
/// let file = br#"{ "fps": 24, "visemes": "MAEO-", "viseme_type": "blair", "text": "Mayor!" }"#;
/// let compiler = Compiler::new(Options::new().default_locale("en-us")?);
/// let bytes = compiler.compile(&[Input::from_bytes("act1/mayor", file)]).into_bank()?;
/// let bank = lipz_bank::Bank::open(&bytes)?.verify()?;
/// assert_eq!(bank.clip_by_key("act1/mayor").map(|clip| clip.frame_count()), Some(5));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Compiler<'p> {
    pub(crate) options: Options,
    pub(crate) progress: Box<Progress<'p>>,
    pub(crate) around_writes: Box<Guard<'p>>,
}

/// A callback that receives the number of files completed since the last call, from several threads.
pub(crate) type Progress<'p> = dyn Fn(u64) + Send + Sync + 'p;

/// A callback that receives the writing of a bank or a cache, and must perform it.
pub(crate) type Guard<'p> = dyn Fn(&mut (dyn FnMut() + Send)) + Send + Sync + 'p;

impl Compiler<'static> {
    /// Creates a compiler with these options.
    pub fn new(options: Options) -> Compiler<'static> {
        Compiler { options, progress: Box::new(|_| {}), around_writes: Box::new(|write| write()) }
    }
}

impl<'p> Compiler<'p> {
    /// Calls `progress` with the number of files completed since its last call, from several threads.
    #[must_use]
    pub fn progress(self, progress: impl Fn(u64) + Send + Sync + 'p) -> Compiler<'p> {
        Compiler { progress: Box::new(progress), ..self }
    }

    /// Passes the writing of each bank and each cache to `guard`, which must perform it. A program that may be asked to
    /// end waits only for that, because reading files and laying out a bank leave nothing behind.
    #[must_use]
    pub fn around_writes(self, guard: impl Fn(&mut (dyn FnMut() + Send)) + Send + Sync + 'p) -> Compiler<'p> {
        Compiler { around_writes: Box::new(guard), ..self }
    }

    /// Writes something through the guard.
    pub(crate) fn call_guarded<R: Send>(&self, write: impl FnOnce() -> R + Send) -> Option<R> {
        let (mut write, mut written) = (Some(write), None);
        (self.around_writes)(&mut || written = write.take().map(|write| write()));
        written
    }

    /// Returns the options of the compiler.
    pub fn options(&self) -> &Options {
        &self.options
    }

    /// Checks `inputs` and, if they have no errors, packs them into a bank.
    pub fn compile(&self, inputs: &[Input]) -> Compiled {
        self.compile_if(inputs, verify)
    }

    /// Checks `inputs` like [`compile`](Self::compile), without making a bank.
    pub fn check(&self, inputs: &[Input]) -> Compiled {
        self.compile_in_pool(|options| {
            CompileRun::read(inputs, options, None, &self.progress).compare_dubs(inputs, options).finish(None)
        })
    }

    /// Compiles like [`compile`](Self::compile), and replaces the file at `path` with the bank, like
    /// [`replace_file`](crate::replace_file). The bank is written to a temporary file piece by piece, and is never in
    /// memory as a whole. The file is renamed to `path` only if each piece is at the position in the tables, and if
    /// these pass verification.
    ///
    /// If the file cannot be written, there is a report and no bank.
    pub fn pack(&self, inputs: &[Input], path: &Path) -> Compiled<OutputFile> {
        self.compile_in_pool(|options| {
            let run = CompileRun::read(inputs, options, None, &self.progress).compare_dubs(inputs, options);
            self.write_bank_of_run(run, inputs, options, (path, Replace::Always)).map(|written| written.file)
        })
    }

    /// Replaces a file with the bank of a run.
    pub(crate) fn write_bank_of_run(
        &self,
        run: CompileRun,
        inputs: &[Input],
        options: &Options,
        (path, replace): (&Path, Replace),
    ) -> Compiled<WrittenBank> {
        let name = |report, _: &[Clips]| in_file(report, inputs);
        run.write(options, name, |layout, clips, check| {
            self.write_bank_of_layout((path, replace), layout, clips, |_| Ok(()), check)
        })
    }

    /// Replaces a file with the bank of a layout, if `confirm` finds that the clips are unchanged after copying, and
    /// `check` accepts the bank.
    pub(crate) fn write_bank_of_layout(
        &self,
        (path, replace): (&Path, Replace),
        layout: &Layout,
        clips: Vec<Clips>,
        confirm: impl FnOnce(&[Clips]) -> Result<(), Report> + Send,
        check: &mut Check<'_>,
    ) -> Result<WrittenBank, Report> {
        self.write_guarded(path, || {
            // The clips are freed before the tables are made again for the check.
            let write = move |file: &mut File| {
                let streamed = stream(layout, &clips, file, true)?;
                confirm(&clips).map_err(WriteFault::Refused)?;
                Ok(streamed)
            };
            let replaced = replace_file_with(path, replace, write, || check().map_err(WriteFault::Refused));
            let (streamed, is_new) = replaced.map_err(|fault| fault.into_report(path))?;
            Ok(WrittenBank {
                file: OutputFile { is_new, ..OutputFile::new(path, streamed.length_bytes) },
                #[cfg(feature = "cache")]
                checksum: streamed.checksum,
            })
        })
    }

    /// Makes a bank in memory, and replaces the file at `path` with it if `accept` succeeds.
    #[cfg(all(feature = "build", not(feature = "cache")))]
    pub(crate) fn pack_if_accepted(
        &self,
        inputs: &[Input],
        path: &Path,
        accept: impl FnOnce(&[u8]) -> Result<(), Report> + Send,
    ) -> Compiled {
        self.compile_if(inputs, |bank| accept(bank).and_then(|()| self.write_verified_bytes(path, bank)))
    }

    /// Checks `inputs` and makes a bank from them, which must be accepted by `finish`.
    fn compile_if(&self, inputs: &[Input], finish: impl FnOnce(&[u8]) -> Result<(), Report> + Send) -> Compiled {
        self.compile_in_pool(|options| {
            let run = CompileRun::read(inputs, options, None, &self.progress).compare_dubs(inputs, options);
            run.make(inputs, options, finish)
        })
    }

    /// Replaces the file at `path` with a bank, which is verified during writing.
    #[cfg(any(feature = "build", feature = "cache"))]
    pub(crate) fn write_verified_bytes(&self, path: &Path, bank: &[u8]) -> Result<(), Report> {
        self.write_checked_bytes(path, bank, || verify(bank))
    }

    /// Replaces the file at `path` with a bank, which `check` examines during writing.
    #[cfg(any(feature = "build", feature = "cache"))]
    pub(crate) fn write_checked_bytes(
        &self,
        path: &Path,
        bank: &[u8],
        check: impl FnOnce() -> Result<(), Report> + Send,
    ) -> Result<(), Report> {
        self.write_guarded(path, || replace_file_if(path, bank, check))
    }

    /// Performs `write` through the program's guard, which must not skip it.
    pub(crate) fn write_guarded<R: Send>(
        &self,
        path: &Path,
        write: impl FnOnce() -> Result<R, Report> + Send,
    ) -> Result<R, Report> {
        self.call_guarded(write).unwrap_or_else(|| {
            let help = "call the function that `around_writes` receives";
            Err(Report::failure(display(path), Code::OutputFailed, "the bank was not written", help))
        })
    }

    /// Runs `work` with the canonical options on the threads of the compiler.
    pub(crate) fn compile_in_pool<B: Send>(&self, work: impl FnOnce(&Options) -> Compiled<B> + Send) -> Compiled<B> {
        self.run_in_pool(work).unwrap_or_else(Compiled::refused)
    }

    /// Runs work with a different result type.
    ///
    /// # Errors
    /// If the options are invalid.
    pub(crate) fn run_in_pool<R: Send>(&self, work: impl FnOnce(&Options) -> R + Send) -> Result<R, Report> {
        let options = self.options.canonical()?;
        Ok(parallel::in_pool(options.threads, || work(&options)))
    }
}

impl Default for Compiler<'static> {
    fn default() -> Self {
        Compiler::new(Options::default())
    }
}

impl From<Options> for Compiler<'static> {
    fn from(options: Options) -> Self {
        Compiler::new(options)
    }
}

impl fmt::Debug for Compiler<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Compiler").field("options", &self.options).finish_non_exhaustive()
    }
}

/// A written bank.
#[derive(Clone, Debug)]
pub(crate) struct WrittenBank {
    pub(crate) file: OutputFile,
    #[cfg(feature = "cache")]
    pub(crate) checksum: u64,
}
