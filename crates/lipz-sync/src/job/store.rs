//! The source and the target of Lipz files during lip sync.

use super::Job;
use super::outcome::NewMouth;
use lipz_diagnostics::Report;
use std::path::Path;
use std::{fs, io};

/// The source and the target of Lipz files during lip sync.
pub(crate) trait ClipStore: Sync {
    /// Returns the bytes of a Lipz file, including the visemes it has received so far.
    fn read(&self, lipz_file: &Path) -> io::Result<Vec<u8>>;

    /// Whether the store is closed for writing.
    fn is_closed(&self) -> bool;

    /// Stores the result of a job. Returns `Err(None)` if the error was already reported.
    fn put(&self, job: &Job, new: &NewMouth) -> Result<(), Option<Report>>;
}

/// The Lipz files themselves, which are read only.
pub(crate) struct ReadOnlyClips;

impl ClipStore for ReadOnlyClips {
    fn read(&self, lipz_file: &Path) -> io::Result<Vec<u8>> {
        fs::read(lipz_file)
    }

    fn is_closed(&self) -> bool {
        true
    }

    fn put(&self, _job: &Job, _new: &NewMouth) -> Result<(), Option<Report>> {
        Err(None)
    }
}
