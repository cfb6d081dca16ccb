//! Commands that change source files: in place, or as a preview of the changes.

use crate::Abort;
use crate::console;
use crate::interrupt::Files;
use crate::reporter::Reporter;
use crate::shared::stdio;
use lipz_compiler::{Content, Input};
use lipz_diagnostics::{Report, escape};
use lipz_texts::difference;
use std::borrow::Cow;
use std::io::{self, IsTerminal};
use std::path::PathBuf;

/// The treatment of a changed file.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum RewriteMode {
    /// Replaced.
    InPlace,
    /// Counted, and listed by name.
    Nothing,
    /// Counted, and shown as a difference.
    Diff,
}

impl RewriteMode {
    /// Changes a file that was read as `before` to `after`. Returns the output about it: nothing if the file is
    /// replaced.
    pub(crate) fn rewrite(self, files: &Files, input: &Input, before: &[u8], after: &str) -> Result<String, Report> {
        match (self, &input.content) {
            (RewriteMode::InPlace, Content::File(path)) => {
                files.rewrite(path, before, after.as_bytes()).map(|()| String::new())
            }
            _ => Ok(self.shown(&input.name(), before, after)),
        }
    }

    /// Returns the output about standard input, or about a file that is not replaced: the new text, the name, or the
    /// difference.
    pub(crate) fn shown(self, name: &str, before: &[u8], after: &str) -> String {
        match self {
            RewriteMode::InPlace => after.to_owned(),
            RewriteMode::Nothing => format!("{}\n", escape::text(name)),
            RewriteMode::Diff => diff(name, before, after),
        }
    }
}

/// Whether standard input is to be changed; the result goes to standard output. It cannot be combined with files, which
/// change in place.
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

/// Returns the difference between two texts of a file in the format of `diff -u` and `patch`, with terminal control
/// characters escaped.
pub(crate) fn diff(name: &str, before: &[u8], after: &str) -> String {
    let before = String::from_utf8_lossy(before);
    // A name may contain line breaks, but the header is one line, and GitHub interprets some lines as commands.
    let name = &escape::text(name);
    let unified = difference::unified(name, &before, after);
    if !io::stdout().is_terminal() {
        return unified;
    }
    unified.lines().flat_map(|line| [escape::text(line), Cow::Borrowed("\n")]).collect()
}

/// Returns `1 file` or `2 files`.
pub(crate) fn files(number: usize) -> String {
    console::counted(number, "file")
}
