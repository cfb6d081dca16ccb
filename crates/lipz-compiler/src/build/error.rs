//! Why a build script failed.

use crate::{LocaleError, VoiceError};
use std::{fmt, io};

/// Why a build script failed, for `main` to return.
pub enum BuildError {
    /// Diagnostics at error level. Cargo shows each.
    Diagnostics {
        /// How many.
        errors: usize,
    },
    /// The script sets an invalid locale.
    Locale(LocaleError),
    /// The script sets an invalid voice.
    Voice(VoiceError),
    /// `OUT_DIR` is not set: the program is not a build script that cargo runs.
    NoOutputFolder,
    /// Standard output, where cargo reads, cannot be written.
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
                f.write_str("OUT_DIR is not set: `lipz_compiler::Build` runs in build scripts of cargo only")
            }
            BuildError::Unheard(error) => write!(f, "standard output cannot be written: {error}"),
        }
    }
}

/// The same words: this is what a `main` that returns the error prints.
impl fmt::Debug for BuildError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl std::error::Error for BuildError {}

/// So that `?` passes on what a setter of [`Options`](crate::Options) refuses.
impl From<LocaleError> for BuildError {
    fn from(error: LocaleError) -> BuildError {
        BuildError::Locale(error)
    }
}

/// The same for the methods of [`Voices`](crate::Voices).
impl From<VoiceError> for BuildError {
    fn from(error: VoiceError) -> BuildError {
        BuildError::Voice(error)
    }
}
