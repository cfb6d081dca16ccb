//! Where a bank goes: to a file, to several, or to standard output.

use crate::Abort;
use crate::reporter::Reporter;
use crate::shared::{output_file, stdio};
use crate::{console, interrupt};
use lipz_compiler::{Compiled, Compiler, Input, Memory, SplitBank};
use std::ffi::OsStr;
use std::fs;
use std::io::{self, IsTerminal};
use std::path::{Path, PathBuf};

/// What the names of text banks end with, behind their locale.
const TEXTS_EXTENSION: &str = ".lipztexts";

/// Where a bank goes.
pub(super) enum Destination {
    StandardOutput,
    File {
        bank: PathBuf,
        /// What is known of the files of the run before.
        cache: Option<PathBuf>,
    },
    /// The texts of each locale into a text bank beside it.
    Split(PathBuf),
}

/// When a file is replaced.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Replacing {
    /// By every run: its time tells build engines that it is up to date.
    Always,
    /// By other bytes only: whoever has it open reads it again only for a reason.
    IfDifferent,
}

/// A file that the run made.
pub(super) struct Written {
    name: String,
    length_bytes: usize,
    /// Whether it was written, rather than found as it should be.
    is_new: bool,
}

/// What was written where.
pub(super) struct AllWritten {
    /// The bank first.
    files: Vec<Written>,
    /// Names of text banks of locales that the bank no longer has.
    stale: Vec<String>,
}

impl Written {
    fn new(name: String, bytes: &[u8]) -> Written {
        Written { name, length_bytes: bytes.len(), is_new: true }
    }
}

impl AllWritten {
    fn one(file: Written) -> AllWritten {
        AllWritten { files: vec![file], stale: Vec::new() }
    }
}

impl Destination {
    /// The destination that the arguments name, or how the run ends if they contradict each other.
    pub(super) fn of(
        output: &Path,
        is_split: bool,
        has_depfile: bool,
        cache: Option<&Path>,
        reporter: &mut Reporter,
    ) -> Result<Destination, Abort> {
        if !stdio::is_meant(output) {
            let path = output.to_owned();
            let whole = |bank| Destination::File { bank, cache: cache.map(Path::to_owned) };
            return Ok(if is_split { Destination::Split(path) } else { whole(path) });
        }
        if is_split || has_depfile {
            let tip = "name a file with `--output`: text banks are written beside it, and a depfile is about it";
            let message = "standard output takes one bank and has no name";
            return Err(reporter.usage(message, tip));
        }
        if io::stdout().is_terminal() {
            return Err(reporter.usage("a bank is not for a terminal", "name a file, or send standard output to one"));
        }
        Ok(Destination::StandardOutput)
    }

    /// Makes the bank. One that replaces a file in any case is written while it is verified.
    pub(super) fn make(&self, compiler: &Compiler<'_>, inputs: &[Input]) -> Compiled {
        let Destination::File { bank, cache } = self else { return compiler.compile(inputs) };
        interrupt::whole(|| match cache {
            Some(cache) => compiler.pack_cached(inputs, bank, cache),
            None => compiler.pack(inputs, bank),
        })
    }

    /// Makes the bank with what is remembered of the run before, first of all that of the cache.
    pub(super) fn make_again(&self, memory: &mut Memory, compiler: &Compiler<'_>, inputs: &[Input]) -> Compiled {
        if let (Destination::File { bank, cache: Some(cache) }, true) = (self, memory.is_empty()) {
            match Memory::read(cache, bank) {
                Ok(read) => *memory = read,
                Err(report) => {
                    let mut refused = Compiled::default();
                    refused.reports.push(report);
                    return refused;
                }
            }
        }
        compiler.compile_again(inputs, memory)
    }

    /// Writes what is remembered into the cache, if there is one.
    pub(super) fn remember(&self, memory: &Memory, reporter: &mut Reporter) -> Result<(), Abort> {
        let Destination::File { cache: Some(cache), .. } = self else { return Ok(()) };
        interrupt::whole(|| memory.write(cache)).map_err(|report| reporter.fail(report))
    }

    /// Brings the bank to where it is not yet. Reports why that is not possible.
    pub(super) fn deliver(
        &self,
        bank: &[u8],
        is_unchanged: bool,
        replacing: Replacing,
        reporter: &mut Reporter,
    ) -> Result<AllWritten, Abort> {
        match self {
            // Written by `make`.
            Destination::File { bank: path, .. } if replacing == Replacing::Always => {
                Ok(AllWritten::one(Written { is_new: !is_unchanged, ..Written::new(console::path(path), bank) }))
            }
            Destination::File { bank: path, .. } => Ok(AllWritten::one(write(path, bank, replacing, reporter)?)),
            Destination::StandardOutput => {
                reporter.print_bytes(bank)?;
                Ok(AllWritten::one(Written::new("standard output".to_owned(), bank)))
            }
            Destination::Split(path) => {
                let split = SplitBank::from_bytes(bank).map_err(|report| reporter.fail(report))?;
                let mut files = Vec::new();
                let mut paths = Vec::new();
                for (tag, texts) in &split.texts {
                    let path = path.with_extension(format!("{tag}{TEXTS_EXTENSION}"));
                    files.push(write(&path, texts, replacing, reporter)?);
                    paths.push(path);
                }
                // The bank last: whoever finds it finds its texts, too.
                files.insert(0, write(path, &split.base, replacing, reporter)?);
                Ok(AllWritten { files, stale: stale(path, &paths) })
            }
        }
    }
}

/// The text banks beside the bank at `path` that are not among those that were written now. They stay: who
/// removes a locale decides about its files.
fn stale(path: &Path, written: &[PathBuf]) -> Vec<String> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let (Some(stem), Ok(files)) = (path.file_stem(), fs::read_dir(folder)) else { return Vec::new() };
    let is_text_bank = |name: &OsStr| {
        let rest = name.as_encoded_bytes().strip_prefix(stem.as_encoded_bytes());
        rest.is_some_and(|rest| rest.starts_with(b".") && rest.ends_with(TEXTS_EXTENSION.as_bytes()))
    };
    let names = files.filter_map(|file| Some(file.ok()?.file_name()));
    let stale = names.filter(|name| is_text_bank(name) && written.iter().all(|path| path.file_name() != Some(name)));
    let mut stale: Vec<String> = stale.map(|name| console::path(&path.with_file_name(name))).collect();
    stale.sort();
    stale
}

/// Replaces a file. Reports why that is not possible.
pub(super) fn write(
    path: &Path,
    bytes: &[u8],
    replacing: Replacing,
    reporter: &mut Reporter,
) -> Result<Written, Abort> {
    let is_new = replacing == Replacing::Always || !has(path, bytes);
    if is_new {
        output_file::write(path, bytes, reporter)?;
    }
    Ok(Written { is_new, ..Written::new(console::path(path), bytes) })
}

/// Whether the file has these bytes.
fn has(path: &Path, bytes: &[u8]) -> bool {
    let is_as_long = path.metadata().is_ok_and(|found| found.is_file() && found.len() == bytes.len() as u64);
    is_as_long && fs::read(path).is_ok_and(|found| found == bytes)
}

impl AllWritten {
    /// A line for each file.
    pub(super) fn summary(&self, clip_count: usize) -> String {
        let line = |(index, file): (usize, &Written)| {
            let what = if index == 0 { console::counted(clip_count, "clip") } else { "texts".to_owned() };
            let done = if file.is_new { "packed into" } else { "unchanged in" };
            format!("{what} {done} {} ({} bytes)\n", file.name, console::grouped(file.length_bytes))
        };
        let stale = |name: &String| format!("not written: {name}, whose locale the bank no longer has\n");
        self.files.iter().enumerate().map(line).chain(self.stale.iter().map(stale)).collect()
    }

    /// One line about all files, and whether any is another than before.
    pub(super) fn message(&self, clip_count: usize) -> String {
        let clips = console::counted(clip_count, "clip");
        let name = self.files.first().map_or("nothing", |bank| bank.name.as_str());
        let length_bytes = self.files.iter().map(|file| file.length_bytes).sum();
        let texts = match self.files.len() {
            0 | 1 => String::new(),
            files => format!(" and {}", console::counted(files - 1, "text bank")),
        };
        let done = match self.files.iter().any(|file| file.is_new) {
            true => format!("{clips} packed into"),
            false => format!("nothing changed: {clips} in"),
        };
        format!("{done} {name}{texts} ({} bytes)", console::grouped(length_bytes))
    }
}
