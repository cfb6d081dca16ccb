//! Why files are not used as a dialogue.

use lipz_bank::ErrorKind;
use std::error::Error;
use std::path::{Path, PathBuf};
use std::{fmt, io};

/// Why files are not used as a [`Dialogue`](crate::Dialogue): which file, what is wrong with it, and what to do.
#[derive(Debug)]
pub struct OpenError {
    path: PathBuf,
    cause: Cause,
}

/// What is wrong with a file.
#[derive(Debug)]
pub(crate) enum Cause {
    /// The system cannot open, read or map it.
    File(io::Error),
    /// It is damaged, or does not fit the others.
    Contents(lipz_bank::Error),
}

impl OpenError {
    pub(crate) fn new(path: &Path, cause: impl Into<Cause>) -> OpenError {
        OpenError { path: path.to_owned(), cause: cause.into() }
    }

    /// The file that is not used.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Whether the file is not there.
    pub(crate) fn is_missing(&self) -> bool {
        self.io_error().map_or(false, |error| error.kind() == io::ErrorKind::NotFound)
    }

    /// The error of the system, if the file cannot be opened, read or mapped.
    pub fn io_error(&self) -> Option<&io::Error> {
        match &self.cause {
            Cause::File(error) => Some(error),
            Cause::Contents(_) => None,
        }
    }

    /// The error of the reader, if the file is damaged or does not fit those before it.
    pub fn bank_error(&self) -> Option<lipz_bank::Error> {
        match &self.cause {
            Cause::File(_) => None,
            Cause::Contents(error) => Some(*error),
        }
    }

    /// What to do about it.
    fn remedy(&self) -> &'static str {
        let kind = match &self.cause {
            Cause::File(_) => return "check the path and whether the file is there",
            Cause::Contents(error) => error.kind(),
        };
        match kind {
            ErrorKind::TextsOnly => "name the bank of these texts before them",
            ErrorKind::OtherClips => "name these texts after the bank that they were split from, or pack both again",
            ErrorKind::NotALayer => "open one whole bank only; pack the others with --over",
            ErrorKind::OtherBase => {
                "name the banks that the patch was packed over before it, or pack it again over these"
            }
            ErrorKind::LayerCount => "name a bank, and at most 15 patches",
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
