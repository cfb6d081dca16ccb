//! The compiler: reads, parses and checks every file in parallel, then localises, lowers and verifies.

mod compiled;
mod file;
mod lint;
mod read;
mod requirements;
mod run;
mod stamped;

pub use compiled::{CompileError, Compiled, Phases};
pub use lint::{Checked, Lint, Linted};
pub(crate) use read::FileReader;
#[cfg(feature = "cache")]
pub(crate) use requirements::Texts;
pub(crate) use run::in_file;
pub(crate) use run::{Check, Run};

use crate::clip::Clips;
use crate::lower::Layout;
use crate::lower::stream::{Fault, stream};
#[cfg(any(feature = "build", feature = "cache"))]
use crate::output::replace_file_if;
use crate::output::replace_file_with;
use crate::{Input, Options, OutputFile, Replace, discover, parallel};
use lipz_bank::Bank;
use lipz_diagnostics::{Code, Report};
use std::fmt;
use std::fs::File;
use std::path::Path;

/// Checks Lipz files and packs them into banks, as the options of a project say.
///
/// The bytes of a bank depend only on keys, contents and options: not on the order of the inputs,
/// their folder, or the number of threads.
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

/// Is called with the number of files that were done since the last call, from several threads.
pub(crate) type Progress<'p> = dyn Fn(u64) + Send + Sync + 'p;

/// Is called with the writing of a bank or a cache, and has to do it.
pub(crate) type Guard<'p> = dyn Fn(&mut (dyn FnMut() + Send)) + Send + Sync + 'p;

impl Compiler<'static> {
    /// A compiler with these options.
    pub fn new(options: Options) -> Compiler<'static> {
        Compiler { options, progress: Box::new(|_| {}), around_writes: Box::new(|write| write()) }
    }
}

impl<'p> Compiler<'p> {
    /// Calls `progress` with the number of files that were done since its last call, from several threads.
    #[must_use]
    pub fn progress(self, progress: impl Fn(u64) + Send + Sync + 'p) -> Compiler<'p> {
        Compiler { progress: Box::new(progress), ..self }
    }

    /// Calls `guard` with the writing of each bank and each cache, which it has to do: a program that may be asked to
    /// end waits for that, and for nothing else. Reading files and laying out a bank leave nothing behind.
    #[must_use]
    pub fn around_writes(self, guard: impl Fn(&mut (dyn FnMut() + Send)) + Send + Sync + 'p) -> Compiler<'p> {
        Compiler { around_writes: Box::new(guard), ..self }
    }

    /// Does some writing as the guard wants it.
    pub(crate) fn guarded<R: Send>(&self, write: impl FnOnce() -> R + Send) -> Option<R> {
        let (mut write, mut written) = (Some(write), None);
        (self.around_writes)(&mut || written = write.take().map(|write| write()));
        written
    }

    /// The options of the compiler.
    pub fn options(&self) -> &Options {
        &self.options
    }

    /// Checks `inputs` and, if they have no errors, packs them into a bank.
    pub fn compile(&self, inputs: &[Input]) -> Compiled {
        self.make(inputs, verify)
    }

    /// Checks `inputs` as [`compile`](Self::compile) does, without making a bank.
    pub fn check(&self, inputs: &[Input]) -> Compiled {
        self.run(|options| Run::read(inputs, options, None, &self.progress).compare_dubs(inputs, options).finish(None))
    }

    /// Does what [`compile`](Self::compile) does, and replaces the file at `path` by the bank as
    /// [`replace_file`](crate::replace_file) does. The bank goes to a temporary file piece by piece, and is never in memory;
    /// that takes the name `path` only if each piece stands where the tables say, and these pass verification.
    ///
    /// If the file cannot be written, a report says so, and there is no bank.
    pub fn pack(&self, inputs: &[Input], path: &Path) -> Compiled<OutputFile> {
        self.run(|options| {
            let run = Run::read(inputs, options, None, &self.progress).compare_dubs(inputs, options);
            self.write_run(run, inputs, options, (path, Replace::Always)).map(|written| written.file)
        })
    }

    /// Replaces a file by the bank of a run.
    pub(crate) fn write_run(
        &self,
        run: Run,
        inputs: &[Input],
        options: &Options,
        (path, replace): (&Path, Replace),
    ) -> Compiled<Written> {
        let name = |report, _: &[Clips]| in_file(report, inputs);
        run.write(options, name, |layout, clips, check| {
            self.write_streamed((path, replace), layout, clips, |_| Ok(()), check)
        })
    }

    /// Replaces a file by the bank of a layout, if `confirm` finds nothing wrong with the clips after they were copied, and `check`
    /// nothing with the bank.
    pub(crate) fn write_streamed(
        &self,
        (path, replace): (&Path, Replace),
        layout: &Layout,
        clips: Vec<Clips>,
        confirm: impl FnOnce(&[Clips]) -> Result<(), Report> + Send,
        check: &mut Check<'_>,
    ) -> Result<Written, Report> {
        self.written(path, || {
            // The clips are given back before the tables are made once more, to be checked.
            let write = move |file: &mut File| {
                let streamed = stream(layout, &clips, file, true)?;
                confirm(&clips).map_err(Fault::Refused)?;
                Ok(streamed)
            };
            let replaced = replace_file_with(path, replace, write, || check().map_err(Fault::Refused));
            let (streamed, is_new) = replaced.map_err(|fault| fault.into_report(path))?;
            Ok(Written {
                file: OutputFile { is_new, ..OutputFile::new(path, streamed.length_bytes) },
                #[cfg(feature = "cache")]
                checksum: streamed.checksum,
            })
        })
    }

    /// Makes a bank in memory, and replaces the file at `path` by it, if `accept` finds nothing in it.
    #[cfg(all(feature = "build", not(feature = "cache")))]
    pub(crate) fn pack_if(
        &self,
        inputs: &[Input],
        path: &Path,
        accept: impl FnOnce(&[u8]) -> Result<(), Report> + Send,
    ) -> Compiled {
        self.make(inputs, |bank| accept(bank).and_then(|()| self.write_verified(path, bank)))
    }

    /// Checks `inputs` and makes a bank of them; there is one only if `finish` accepts it.
    fn make(&self, inputs: &[Input], finish: impl FnOnce(&[u8]) -> Result<(), Report> + Send) -> Compiled {
        self.run(|options| {
            let run = Run::read(inputs, options, None, &self.progress).compare_dubs(inputs, options);
            run.make(inputs, options, finish)
        })
    }

    /// Replaces the file at `path` by a bank, which is verified meanwhile.
    #[cfg(any(feature = "build", feature = "cache"))]
    pub(crate) fn write_verified(&self, path: &Path, bank: &[u8]) -> Result<(), Report> {
        self.write_if(path, bank, || verify(bank))
    }

    /// Replaces the file at `path` by a bank, which `check` looks at meanwhile.
    #[cfg(any(feature = "build", feature = "cache"))]
    pub(crate) fn write_if(
        &self,
        path: &Path,
        bank: &[u8],
        check: impl FnOnce() -> Result<(), Report> + Send,
    ) -> Result<(), Report> {
        self.written(path, || replace_file_if(path, bank, check))
    }

    /// Does a `write` around which the program may do something, and which it must not leave out.
    pub(crate) fn written<R: Send>(
        &self,
        path: &Path,
        write: impl FnOnce() -> Result<R, Report> + Send,
    ) -> Result<R, Report> {
        self.guarded(write).unwrap_or_else(|| {
            let help = "call what `around_writes` is given";
            Err(Report::failure(discover::display(path), Code::OutputFailed, "the bank was not written", help))
        })
    }

    /// Does `work` with the canonical options on the threads of the compiler.
    pub(crate) fn run<B: Send>(&self, work: impl FnOnce(&Options) -> Compiled<B> + Send) -> Compiled<B> {
        self.run_any(work).unwrap_or_else(Compiled::refused)
    }

    /// The same for work with another result.
    ///
    /// # Errors
    /// If the options are not those of a project.
    pub(crate) fn run_any<R: Send>(&self, work: impl FnOnce(&Options) -> R + Send) -> Result<R, Report> {
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

/// A bank that was written.
#[derive(Clone, Debug)]
pub(crate) struct Written {
    pub(crate) file: OutputFile,
    #[cfg(feature = "cache")]
    pub(crate) checksum: u64,
}

/// What the reader finds at fault with the bank: a defect of this compiler, and better found now than in
/// a game.
pub(crate) fn verify(bank: &[u8]) -> Result<(), Report> {
    // Not core's check of UTF-8, which takes longer than all others together.
    let utf8 = |bytes| simdutf8::basic::from_utf8(bytes).ok();
    verified(Bank::open(bank).and_then(|bank| bank.verify_with(utf8).map(|_| ())))
}

/// The same for a bank with zeros where its clips own something.
pub(crate) fn verify_tables(tables: &[u8]) -> Result<(), Report> {
    verified(Bank::open(tables).and_then(|bank| bank.verify_tables()))
}

fn verified(found: Result<(), lipz_bank::Error>) -> Result<(), Report> {
    found.map_err(|error| {
        let message = format!("the bank that was made does not pass verification: {error}");
        let help = "this is a defect of lipz: please report it with the files that lead to it";
        Report::failure("", Code::BankDamaged, message, help)
    })
}
