//! The run: read, parse and check every file in parallel, then localise, lower and verify.

mod demands;
mod file;
mod read;
mod run;

pub(crate) use read::FileReader;
pub(crate) use run::Run;

use crate::output::replace_file_if;
use crate::{Input, Options};
use lipz_bank::Bank;
use lipz_diagnostics::{Code, Report};
use std::path::Path;
use std::time::Duration;

/// What a run gave.
#[derive(Debug, Default)]
pub struct Compiled {
    /// The bank, verified; `None` if there are errors, or only a check was asked for.
    pub bank: Option<Vec<u8>>,
    /// All findings, sorted by file and place.
    pub reports: Vec<Report>,
    /// Clips that were not made anew: see [`pack_cached`](crate::pack_cached) and [`Memory`](crate::Memory).
    pub recalled: usize,
    /// Whether the bank was left as it is, because no clip changed.
    pub is_unchanged: bool,
    /// Where the time went.
    pub phases: Phases,
}

impl Compiled {
    /// A run that this finding keeps from starting.
    pub(crate) fn refused(report: Report) -> Compiled {
        Compiled { reports: vec![report], ..Compiled::default() }
    }
}

/// Time spent per phase. Recalling, reading, parsing and checking run on several threads: their
/// times are sums over the threads.
#[derive(Clone, Copy, Debug, Default)]
pub struct Phases {
    /// Reading the cache and the bank that it is about, and writing the cache.
    pub cache: Duration,
    /// Looking at files and recalling their clips, all threads.
    pub recall: Duration,
    /// Reading files, all threads.
    pub read: Duration,
    /// Parsing, all threads.
    pub parse: Duration,
    /// Checking, all threads.
    pub check: Duration,
    /// The four above, on the clock.
    pub files: Duration,
    /// Resolving locales.
    pub localise: Duration,
    /// Laying out and filling the bank, and giving back what it was made from.
    pub lower: Duration,
    /// Verifying the bank and, in [`pack`], writing it at the same time.
    pub finish: Duration,
}

/// Is told how many more files are done, from several threads.
pub type Progress<'a> = dyn Fn(u64) + Sync + 'a;

/// Checks `inputs` and, if they have no errors, packs them into a bank.
///
/// The bytes of the bank depend only on keys, contents and options: not on the order of the inputs,
/// their folder, or the number of threads.
///
/// ```
/// use lipz_compiler::{Input, Options, compile};
/// let file = br#"{ "fps": 24, "visemes": "MAEO-", "viseme_type": "blair", "text_en-us": "Mayor!" }"#;
/// let compiled = compile(&[Input::from_bytes("act1/mayor", file)], &Options::default(), &|_| {});
/// assert!(compiled.reports.is_empty());
/// let bytes = compiled.bank.ok_or("no bank")?;
/// let bank = lipz_bank::Bank::open(&bytes)?.verify()?;
/// assert_eq!(bank.clip_by_key("act1/mayor").map(|clip| clip.frame_count()), Some(5));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn compile(inputs: &[Input], options: &Options, progress: &Progress<'_>) -> Compiled {
    make(inputs, options, progress, verify)
}

/// Does what [`compile`] does, and replaces the file at `path` by the bank as [`replace_file`](crate::replace_file) does. It is
/// verified while it is written to a temporary file, which takes the name `path` only after both: that is
/// faster than one after the other.
///
/// If the file cannot be written, a report says so, and there is no bank.
pub fn pack(inputs: &[Input], options: &Options, path: &Path, progress: &Progress<'_>) -> Compiled {
    make(inputs, options, progress, |bank| write_verified(path, bank))
}

/// Checks `inputs`, makes a bank of them and hands it to `finish`, without whose consent there is none.
fn make(
    inputs: &[Input],
    options: &Options,
    progress: &Progress<'_>,
    finish: impl FnOnce(&[u8]) -> Result<(), Report> + Send,
) -> Compiled {
    match options.canonical() {
        Ok(options) => in_pool(&options, || Run::read(inputs, &options, None, progress).make(inputs, &options, finish)),
        Err(report) => Compiled::refused(report),
    }
}

/// Replaces the file at `path` by a bank, which is verified meanwhile.
pub(crate) fn write_verified(path: &Path, bank: &[u8]) -> Result<(), Report> {
    replace_file_if(path, bank, || verify(bank))
}

/// Checks `inputs` as [`compile`] does, without making a bank.
pub fn check_all(inputs: &[Input], options: &Options, progress: &Progress<'_>) -> Compiled {
    match options.canonical() {
        Ok(options) => in_pool(&options, || Run::read(inputs, &options, None, progress).finish(None)),
        Err(report) => Compiled::refused(report),
    }
}

/// Runs `work` with the number of threads that was asked for; on the current ones if there is no
/// starting others.
pub(crate) fn in_pool<R: Send>(options: &Options, work: impl FnOnce() -> R + Send) -> R {
    match options.threads {
        Some(count) => match rayon::ThreadPoolBuilder::new().num_threads(count).build() {
            Ok(pool) => pool.install(work),
            Err(_) => work(),
        },
        None => work(),
    }
}

/// What the reader finds at fault with the bank: a defect of this compiler, and better found now than in
/// a game.
pub(crate) fn verify(bank: &[u8]) -> Result<(), Report> {
    // Not core's check of UTF-8, which takes longer than all others together.
    let utf8 = |bytes| simdutf8::basic::from_utf8(bytes).ok();
    match Bank::open(bank).and_then(|bank| bank.verify_with(utf8)) {
        Ok(_) => Ok(()),
        Err(error) => Err(Report::failure(
            "",
            Code::BankDamaged,
            format!("the bank that was made does not pass verification: {error}"),
            "this is a defect of lipz: please report it with the files that lead to it",
        )),
    }
}
