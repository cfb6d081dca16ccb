//! The destination of a bank: files, or standard output.

use crate::Abort;
use crate::reporter::Reporter;
use crate::shared::split::Split;
use crate::shared::stdio;
use crate::{console, interrupt};
use lipz_compiler::{Compiled, Compiler, DeliveredFiles, Input, Memory, OutputFile, Outputs, Replace, StackBelow};
use lipz_diagnostics::Report;
use std::path::{Path, PathBuf};

/// The destination of a bank.
pub(super) enum Destination {
    StandardOutput,
    Files(Outputs),
    /// A layer on top of other banks, in a file or, without a path, on standard output.
    Layer(Option<PathBuf>, Box<StackBelow>),
}

/// A finished bank.
pub(super) enum PackedBank {
    Bytes(Vec<u8>),
    /// Already in its files.
    Files(DeliveredFiles),
}

impl Destination {
    /// Creates the destination from the arguments. Reports contradictions between them.
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
            let tip = "name a file with `--output`";
            let message = "split banks and depfiles need an output file";
            return Err(reporter.usage(message, tip));
        }
        stdio::refuse_terminal(reporter)?;
        Ok(Destination::StandardOutput)
    }

    /// Whether standard output receives the bank.
    pub(super) fn is_standard_output(&self) -> bool {
        matches!(self, Destination::StandardOutput | Destination::Layer(None, _))
    }

    /// Whether the bank is a layer on top of others.
    pub(super) fn is_layer(&self) -> bool {
        matches!(self, Destination::Layer(..))
    }

    /// Compiles the bank, and writes its files.
    pub(super) fn make(&self, compiler: &Compiler<'_>, inputs: &[Input]) -> Compiled<PackedBank> {
        match self {
            Destination::StandardOutput => compiler.compile(inputs).map(PackedBank::Bytes),
            Destination::Files(outputs) => outputs.pack(compiler, inputs).map(PackedBank::Files),
            Destination::Layer(_, over) => compiler.compile_over(inputs, over).map(PackedBank::Bytes),
        }
    }

    /// Compiles the bank with the memory of the previous run, initially that of the cache, and writes its files. If
    /// `changed` names the files that can have changed since then, no others are read.
    pub(super) fn make_again(
        &self,
        memory: &mut Memory,
        compiler: &Compiler<'_>,
        inputs: &[Input],
        changed: Option<&[usize]>,
    ) -> Compiled<PackedBank> {
        match self {
            Destination::StandardOutput => compiler.compile_again(inputs, memory).map(PackedBank::Bytes),
            Destination::Files(outputs) => outputs.pack_again(compiler, inputs, changed, memory).map(PackedBank::Files),
            Destination::Layer(_, over) => compiler.compile_over(inputs, over).map(PackedBank::Bytes),
        }
    }

    /// Writes the memory to the cache, if there is one.
    pub(super) fn remember(&self, memory: &Memory, reporter: &mut Reporter) -> Result<(), Abort> {
        let Destination::Files(outputs) = self else { return Ok(()) };
        interrupt::whole(|| outputs.remember(memory)).map_err(|report| reporter.fail(report))
    }

    /// Writes a bank that is still in memory. Reports errors.
    pub(super) fn deliver(
        &self,
        made: PackedBank,
        replace: Replace,
        reporter: &mut Reporter,
    ) -> Result<DeliveredFiles, Abort> {
        let bank = match made {
            PackedBank::Bytes(bank) => bank,
            PackedBank::Files(delivered) => return Ok(delivered),
        };
        if let Destination::Layer(Some(path), _) = self {
            let written = interrupt::whole(|| OutputFile::write(path, &bank, replace));
            return written.map(DeliveredFiles::from).map_err(|report| reporter.fail(report));
        }
        reporter.print_bytes(&bank)?;
        Ok(OutputFile::new(STANDARD_OUTPUT, bank.len()).into())
    }
}

/// The name of standard output where files have a path.
const STANDARD_OUTPUT: &str = "standard output";

/// Replaces a file that accompanies an already written bank. Reports errors.
pub(super) fn write(path: &Path, bytes: &[u8], replace: Replace, reporter: &mut Reporter) -> Result<(), Abort> {
    let written = interrupt::whole(|| OutputFile::write(path, bytes, replace));
    written.map(drop).map_err(|report| without(report, reporter))
}

/// Reports that an already written bank lacks one of its accompanying files.
pub(super) fn without(mut report: Report, reporter: &mut Reporter) -> Abort {
    let note = "the bank itself was written";
    report.diagnostics.iter_mut().for_each(|diagnostic| diagnostic.notes.push(note.to_owned()));
    reporter.fail(report)
}

/// Returns a line for each file.
pub(super) fn summary(delivered: &DeliveredFiles, contents: &str) -> String {
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
    let stale = |path: &PathBuf| {
        format!("left unchanged: {}, because the bank no longer has its locale\n", console::path(path))
    };
    delivered.files.iter().enumerate().map(line).chain(delivered.stale.iter().map(stale)).collect()
}

/// Returns one line about all files, and whether any of them changed.
pub(super) fn message(delivered: &DeliveredFiles, contents: &str) -> String {
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
        false => format!("unchanged: {contents} in"),
    };
    format!("{done} {name}{beside} ({} bytes)", console::grouped(length_bytes))
}
