//! The error for files that cannot be used as a dialogue.

use lipz_bank::ErrorKind;
use std::error::Error;
use std::path::{Path, PathBuf};
use std::{fmt, io};

/// Why files cannot be used as a [`Dialogue`](crate::Dialogue): the file, its problem, and a remedy.
#[derive(Debug)]
pub struct OpenError {
    path: PathBuf,
    cause: Cause,
}

/// The problem of a file.
#[derive(Debug)]
pub(crate) enum Cause {
    /// The system cannot open, read or map it.
    File(io::Error),
    /// It is damaged, or does not match the others.
    Contents(lipz_bank::Error),
}

impl OpenError {
    pub(crate) fn new(path: &Path, cause: impl Into<Cause>) -> OpenError {
        OpenError { path: path.to_owned(), cause: cause.into() }
    }

    /// Returns the path of the unusable file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Whether the file is missing.
    pub(crate) fn is_missing(&self) -> bool {
        self.io_error().map_or(false, |error| error.kind() == io::ErrorKind::NotFound)
    }

    /// Returns the error of the system, if the file cannot be opened, read or mapped.
    pub fn io_error(&self) -> Option<&io::Error> {
        match &self.cause {
            Cause::File(error) => Some(error),
            Cause::Contents(_) => None,
        }
    }

    /// Returns the error of the reader, if the file is damaged or does not match those before it.
    pub fn bank_error(&self) -> Option<lipz_bank::Error> {
        match &self.cause {
            Cause::File(_) => None,
            Cause::Contents(error) => Some(*error),
        }
    }

    /// Returns advice on how to solve the problem.
    fn remedy(&self) -> &'static str {
        let kind = match &self.cause {
            Cause::File(_) => return "check the path of the file",
            Cause::Contents(error) => error.kind(),
        };
        match kind {
            ErrorKind::TextsOnly => "name the bank of these texts before them",
            ErrorKind::OtherClips => "name these texts after the bank that they were split from, or pack both again",
            ErrorKind::NotALayer => "open only one complete bank, and pack the others with --over",
            ErrorKind::OtherBase => {
                "before the patch, name the banks that it was packed over, or pack it again over these"
            }
            ErrorKind::LayerCount => "name one bank and at most 15 patches",
            ErrorKind::OtherBank => "copy all banks of the set together with its index",
            ErrorKind::UnsupportedVersion | ErrorKind::SectionUnknown => "update lipz, or pack the file again",
            ErrorKind::NotABank | ErrorKind::NotASet => "name a file that lipz has packed",
            _ => "copy the file again, or pack it again",
        }
    }
}

impl fmt::Display for OpenError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let path = self.path.display();
        match &self.cause {
            Cause::File(error) => write!(f, "{path}: {error}; {}", self.remedy()),
            Cause::Contents(error) => write!(f, "{path}: {error}; {}", self.remedy()),
        }
    }
}

impl Error for OpenError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        match &self.cause {
            Cause::File(error) => Some(error),
            Cause::Contents(error) => Some(error),
        }
    }
}

impl From<io::Error> for Cause {
    fn from(error: io::Error) -> Cause {
        Cause::File(error)
    }
}

impl From<lipz_bank::Error> for Cause {
    fn from(error: lipz_bank::Error) -> Cause {
        Cause::Contents(error)
    }
}
