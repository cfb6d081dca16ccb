//! Errors of build scripts.

use crate::project::{LocaleError, VoiceError};
use std::{fmt, io};

/// An error of a build script, for `main` to return.
pub enum BuildError {
    /// Diagnostics at error level, which cargo shows.
    Diagnostics {
        /// Their number.
        errors: usize,
    },
    /// The script sets an invalid locale.
    Locale(LocaleError),
    /// The script sets an invalid voice.
    Voice(VoiceError),
    /// `OUT_DIR` is not set, because the program is not a build script run by cargo.
    NoOutputFolder,
    /// Writing to standard output, where cargo reads, failed.
    Unheard(io::Error),
}

impl fmt::Display for BuildError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            BuildError::Diagnostics { errors: 1 } => f.write_str("1 error in Lipz files; no bank was written"),
            BuildError::Diagnostics { errors } => write!(f, "{errors} errors in Lipz files; no bank was written"),
            BuildError::Locale(error) => write!(f, "{error}"),
            BuildError::Voice(error) => write!(f, "{error}"),
            BuildError::NoOutputFolder => {
                f.write_str("OUT_DIR is not set: `lipz_compiler::Build` runs only in cargo build scripts")
            }
            BuildError::Unheard(error) => write!(f, "standard output cannot be written: {error}"),
        }
    }
}

/// The same text as `Display`, because it is printed when `main` returns the error.
impl fmt::Debug for BuildError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl std::error::Error for BuildError {}

/// Allows `?` on the setters of [`Options`](crate::Options).
impl From<LocaleError> for BuildError {
    fn from(error: LocaleError) -> BuildError {
        BuildError::Locale(error)
    }
}

/// Allows `?` on the methods of [`Voices`](crate::Voices).
impl From<VoiceError> for BuildError {
    fn from(error: VoiceError) -> BuildError {
        BuildError::Voice(error)
    }
}
