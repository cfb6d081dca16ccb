//! Commands that change source files: replacing them, or only showing what would change.

use crate::Abort;
use crate::console;
use crate::interrupt::Files;
use crate::reporter::Reporter;
use crate::shared::stdio;
use lipz_compiler::{Content, Input};
use lipz_diagnostics::{Report, escape};
use similar::TextDiff;
use std::borrow::Cow;
use std::io::{self, IsTerminal};
use std::path::PathBuf;

/// What is done with a file that changes.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Rewriting {
    /// It is replaced.
    InPlace,
    /// It is only counted.
    Nothing,
    /// It is only counted, with the difference.
    Diff,
}

impl Rewriting {
    /// Makes `after` of the file that was read as `before`. Gives the difference if it is asked for.
    pub(crate) fn rewrite(self, files: &Files, input: &Input, before: &[u8], after: &str) -> Result<String, Report> {
        match (self, &input.content) {
            (Rewriting::InPlace, Content::File(path)) => {
                files.rewrite(path, before, after.as_bytes()).map(|()| String::new())
            }
            (Rewriting::Diff, _) => Ok(diff(&input.name(), before, after)),
            _ => Ok(String::new()),
        }
    }
}

/// Whether standard input is what changes; it goes to standard output then. Beside files, which stay where
/// they are, it cannot.
pub(crate) fn reads_standard_input(sources: &[PathBuf], reporter: &mut Reporter) -> Result<bool, Abort> {
    if sources.len() > 1 && sources.iter().any(|source| stdio::is_meant(source)) {
        let tip = "name `-` alone, or files and folders only";
        return Err(reporter.usage("standard input cannot be rewritten together with files", tip));
    }
    Ok(is_standard_input(sources))
}

/// Whether standard input is the only source.
pub(crate) fn is_standard_input(sources: &[PathBuf]) -> bool {
    matches!(sources, [source] if stdio::is_meant(source))
}

/// The difference between two texts of a file, as `diff -u` and `patch` know it. Bytes that steer a
/// terminal do not reach one.
pub(crate) fn diff(name: &str, before: &[u8], after: &str) -> String {
    let before = String::from_utf8_lossy(before);
    // A name may have line breaks: one line is the header, and GitHub takes others for commands.
    let name = &escape::text(name);
    let unified = TextDiff::from_lines(before.as_ref(), after).unified_diff().header(name, name).to_string();
    if !io::stdout().is_terminal() {
        return unified;
    }
    unified.lines().flat_map(|line| [escape::text(line), Cow::Borrowed("\n")]).collect()
}

/// `1 file`, `2 files`.
pub(crate) fn files(number: usize) -> String {
    console::counted(number, "file")
}
