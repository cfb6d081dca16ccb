//! Where a bank goes: to a file, to several, or to standard output.

use crate::render::Findings;
use crate::sources::usage_error;
use crate::{Outcome, console, interrupt, standard};
use clap::error::ErrorKind;
use lipz_compiler::{Compiled, Input, Options, Progress, compile, pack, pack_cached, replace_file, split};
use std::io::{self, IsTerminal};
use std::path::Path;

/// Where a bank goes.
pub(super) enum Destination<'a> {
    StandardOutput,
    File {
        bank: &'a Path,
        /// What is known of the files of the run before.
        cache: Option<&'a Path>,
    },
    /// The texts of each locale into a text bank beside it.
    Split(&'a Path),
}

/// What was written where: names of files with their lengths in bytes, the bank first.
pub(super) struct Written(Vec<(String, usize)>);

impl<'a> Destination<'a> {
    /// The destination that the arguments name, or how the run ends if they contradict each other.
    pub(super) fn of(
        output: &'a Path,
        is_split: bool,
        has_depfile: bool,
        cache: Option<&'a Path>,
    ) -> Result<Destination<'a>, Outcome> {
        if !standard::is_meant(output) {
            let whole = Destination::File { bank: output, cache };
            return Ok(if is_split { Destination::Split(output) } else { whole });
        }
        if is_split || has_depfile {
            let tip = "name a file with '--output': text banks are written beside it, and a depfile is about it";
            let message = "standard output holds one bank and has no name";
            return Err(usage_error(ErrorKind::ArgumentConflict, message, tip));
        }
        if io::stdout().is_terminal() {
            console::remark("error: a bank is not for a terminal\nhelp: name a file, or send standard output to one\n");
            return Err(Outcome::Failed);
        }
        Ok(Destination::StandardOutput)
    }

    /// Makes the bank. One that goes to a file is written while it is verified.
    pub(super) fn make(&self, inputs: &[Input], options: &Options, progress: &Progress<'_>) -> Compiled {
        let Destination::File { bank, cache } = self else { return compile(inputs, options, progress) };
        let progress = |files| {
            progress(files);
            interrupt::point();
        };
        interrupt::whole(|| match cache {
            Some(cache) => pack_cached(inputs, options, bank, cache, &progress),
            None => pack(inputs, options, bank, &progress),
        })
    }

    /// Brings the bank to where it is not yet. Reports why that is not possible.
    pub(super) fn deliver(&self, bank: &[u8], findings: &mut Findings) -> Result<Written, Outcome> {
        match self {
            Destination::File { bank: path, .. } => Ok(Written(vec![(console::path(path), bank.len())])),
            Destination::StandardOutput => match console::print_bytes(bank) {
                Outcome::Clean => Ok(Written(vec![("standard output".to_owned(), bank.len())])),
                failed => Err(failed),
            },
            Destination::Split(path) => {
                let split = split(bank).map_err(|report| {
                    findings.add(vec![report]);
                    Outcome::Failed
                })?;
                let mut files = Vec::new();
                for (tag, texts) in &split.texts {
                    files.push(write(&path.with_extension(format!("{tag}.lipztexts")), texts, findings)?);
                }
                // The bank last: whoever finds it finds its texts, too.
                files.insert(0, write(path, &split.base, findings)?);
                Ok(Written(files))
            }
        }
    }
}

/// Replaces a file; gives its name and length. Reports why that is not possible.
pub(super) fn write(path: &Path, bytes: &[u8], findings: &mut Findings) -> Result<(String, usize), Outcome> {
    interrupt::whole(|| replace_file(path, bytes)).map_err(|report| {
        findings.add(vec![report]);
        Outcome::Failed
    })?;
    Ok((console::path(path), bytes.len()))
}

impl Written {
    /// A line for each file.
    pub(super) fn summary(&self, clip_count: usize, is_unchanged: bool) -> String {
        let done = if is_unchanged { "unchanged in" } else { "packed into" };
        let line = |(index, (name, length_bytes)): (usize, &(String, usize))| {
            let what = if index == 0 { console::counted(clip_count, "clip") } else { "texts".to_owned() };
            format!("{what} {done} {name} ({} bytes)\n", console::grouped(*length_bytes))
        };
        self.0.iter().enumerate().map(line).collect()
    }
}
