//! An output file of a run, and the condition for replacing it.

use super::file_eq::has;
use super::output::replace_file;
use lipz_diagnostics::Report;
use std::path::{Path, PathBuf};

/// The condition for replacing a file.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Replace {
    /// In every run, because build engines compare its time.
    Always,
    /// Only if the bytes differ, so that programs that have it open do not read it again without a reason.
    IfDifferent,
}

impl Replace {
    /// Whether to replace the file at `path` with these bytes.
    pub(crate) fn is_due(self, path: &Path, bytes: &[u8]) -> bool {
        self == Replace::Always || !has(path, bytes)
    }
}

/// An output file of a run.
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub struct OutputFile {
    /// Its path.
    pub path: PathBuf,
    /// Its length.
    pub length_bytes: usize,
    /// The number of its clips, if it is one of several banks among which the clips of the run are divided.
    pub clip_count: Option<usize>,
    /// Whether it was written, and not found unchanged.
    pub is_new: bool,
}

impl OutputFile {
    /// Creates the entry for a file of this length that a run wrote.
    pub fn new(path: impl Into<PathBuf>, length_bytes: usize) -> OutputFile {
        OutputFile { path: path.into(), length_bytes, clip_count: None, is_new: true }
    }

    /// Replaces the file at `path` with `bytes`, like [`replace_file`].
    ///
    /// # Errors
    /// Those of [`replace_file`].
    pub fn write(path: &Path, bytes: &[u8], replace: Replace) -> Result<OutputFile, Report> {
        let is_new = replace.is_due(path, bytes);
        if is_new {
            replace_file(path, bytes)?;
        }
        Ok(OutputFile { is_new, ..OutputFile::new(path, bytes.len()) })
    }
}
