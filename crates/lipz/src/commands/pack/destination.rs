//! Where a bank goes: to files, or to standard output.

use crate::Abort;
use crate::reporter::Reporter;
use crate::shared::stdio;
use crate::{console, interrupt};
use lipz_compiler::{Compiled, Compiler, Delivered, Input, Memory, OutputFile, Outputs, Over, Replace};
use lipz_diagnostics::Report;
use std::io::{self, IsTerminal};
use std::path::{Path, PathBuf};

/// What is put into files of its own.
#[derive(Clone, Copy)]
pub(crate) struct Split {
    /// The texts of each locale.
    pub(crate) locales: bool,
    /// The dubs of each voice.
    pub(crate) voices: bool,
}

impl Split {
    /// Refuses to do both.
    pub(crate) fn refuse_both(self, reporter: &mut Reporter) -> Result<(), Abort> {
        if self.locales && self.voices {
            let tip = "leave one of them out, or say `--split-locales=false`: banks of voices need the texts of the bank below them";
            return Err(reporter.usage("a bank is split by locale or by voice", tip));
        }
        Ok(())
    }

    /// The files of a bank.
    pub(crate) fn outputs(self, bank: &Path) -> Outputs {
        Outputs::new(bank).split_locales(self.locales).split_voices(self.voices)
    }
}

/// Where a bank goes.
pub(super) enum Destination {
    StandardOutput,
    Files(Outputs),
    /// A layer over other banks: a file, or standard output without one.
    Layer(Option<PathBuf>, Box<Over>),
}

/// A bank that was made.
pub(super) enum Made {
    Bytes(Vec<u8>),
    /// Where it belongs.
    Files(Delivered),
}

impl Destination {
    /// The destination that the arguments name, or how the run ends if they contradict each other.
    pub(super) fn new(
        output: &Path,
        split: Split,
        has_depfile: bool,
        cache: Option<&Path>,
        reporter: &mut Reporter,
    ) -> Result<Destination, Abort> {
        if !stdio::is_meant(output) {
            let cache = cache.map(Path::to_owned);
            return Ok(Destination::Files(split.outputs(output).cache(cache)));
        }
        if split.locales || split.voices || has_depfile {
            let tip = "name a file with `--output`: text banks and those of voices are written beside it, and a depfile is about it";
            let message = "standard output takes one bank and has no name";
            return Err(reporter.usage(message, tip));
        }
        if io::stdout().is_terminal() {
            return Err(reporter.usage("a bank is not for a terminal", "name a file, or send standard output to one"));
        }
        Ok(Destination::StandardOutput)
    }

    /// Whether the bank goes to standard output.
    pub(super) fn is_standard_output(&self) -> bool {
        matches!(self, Destination::StandardOutput | Destination::Layer(None, _))
    }

    /// Whether the bank is a layer over others.
    pub(super) fn is_layer(&self) -> bool {
        matches!(self, Destination::Layer(..))
    }

    /// Makes the bank, and writes its files.
    pub(super) fn make(&self, compiler: &Compiler<'_>, inputs: &[Input]) -> Compiled<Made> {
        match self {
            Destination::StandardOutput => compiler.compile(inputs).map(Made::Bytes),
            Destination::Files(outputs) => outputs.pack(compiler, inputs).map(Made::Files),
            Destination::Layer(_, over) => compiler.compile_over(inputs, over).map(Made::Bytes),
        }
    }

    /// Makes the bank with what is remembered of the previous run, first of all that of the cache, and writes its files. If it is
    /// known which files can have `changed` since then, no other is looked at.
    pub(super) fn make_again(
        &self,
        memory: &mut Memory,
        compiler: &Compiler<'_>,
        inputs: &[Input],
        changed: Option<&[usize]>,
    ) -> Compiled<Made> {
        match self {
            Destination::StandardOutput => compiler.compile_again(inputs, memory).map(Made::Bytes),
            Destination::Files(outputs) => outputs.pack_again(compiler, inputs, changed, memory).map(Made::Files),
            Destination::Layer(_, over) => compiler.compile_over(inputs, over).map(Made::Bytes),
        }
    }

    /// Writes what is remembered into the cache, if there is one.
    pub(super) fn remember(&self, memory: &Memory, reporter: &mut Reporter) -> Result<(), Abort> {
        let Destination::Files(outputs) = self else { return Ok(()) };
        interrupt::whole(|| outputs.remember(memory)).map_err(|report| reporter.fail(report))
    }

    /// Brings the bank to where it is not yet. Reports why that is not possible.
    pub(super) fn deliver(&self, made: Made, replace: Replace, reporter: &mut Reporter) -> Result<Delivered, Abort> {
        let bank = match made {
            Made::Bytes(bank) => bank,
            Made::Files(delivered) => return Ok(delivered),
        };
        if let Destination::Layer(Some(path), _) = self {
            let written = interrupt::whole(|| OutputFile::write(path, &bank, replace));
            return written.map(Delivered::from).map_err(|report| reporter.fail(report));
        }
        reporter.print_bytes(&bank)?;
        Ok(OutputFile::new(STANDARD_OUTPUT, bank.len()).into())
    }
}

/// What standard output is called where a file has a path.
const STANDARD_OUTPUT: &str = "standard output";

/// Replaces a file that goes with a bank, which is written by then. Reports why that is not possible.
pub(super) fn write(path: &Path, bytes: &[u8], replace: Replace, reporter: &mut Reporter) -> Result<(), Abort> {
    let written = interrupt::whole(|| OutputFile::write(path, bytes, replace));
    written.map(drop).map_err(|report| without(report, reporter))
}

/// Reports why the bank, which is written by then, has to do without a file that goes with it.
pub(super) fn without(mut report: Report, reporter: &mut Reporter) -> Abort {
    let note = "the bank itself is written";
    report.diagnostics.iter_mut().for_each(|diagnostic| diagnostic.notes.push(note.to_owned()));
    reporter.fail(report)
}

/// A line for each file.
pub(super) fn summary(delivered: &Delivered, contents: &str) -> String {
    let line = |(index, file): (usize, &OutputFile)| {
        let what = match (index, file.clip_count) {
            (0, None) => contents.to_owned(),
            (0, Some(originals)) => console::counted(originals, "clip"),
            (_, Some(dubs)) => console::counted(dubs, "dub"),
            (_, None) => "texts".to_owned(),
        };
        let done = if file.is_new { "packed into" } else { "unchanged in" };
        format!("{what} {done} {} ({} bytes)\n", console::path(&file.path), console::grouped(file.length_bytes))
    };
    let stale = |path: &PathBuf| format!("not written: {}, whose locale the bank no longer has\n", console::path(path));
    delivered.files.iter().enumerate().map(line).chain(delivered.stale.iter().map(stale)).collect()
}

/// One line about all files, and whether any is another than before.
pub(super) fn message(delivered: &Delivered, contents: &str) -> String {
    let name = delivered.files.first().map_or_else(String::new, |bank| console::path(&bank.path));
    let length_bytes = delivered.files.iter().map(|file| file.length_bytes).sum();
    let beside = match delivered.files.get(1) {
        Some(file) => {
            let what = if file.clip_count.is_some() { "voice" } else { "text bank" };
            format!(" and {}", console::counted(delivered.files.len() - 1, what))
        }
        None => String::new(),
    };
    let done = match delivered.files.iter().any(|file| file.is_new) {
        true => format!("{contents} packed into"),
        false => format!("nothing changed: {contents} in"),
    };
    format!("{done} {name}{beside} ({} bytes)", console::grouped(length_bytes))
}
