//! Why a file is not used as a bank.

use std::{fmt, io};

/// Why a file is not used as a bank.
#[derive(Debug)]
pub enum Error {
    /// The system refuses to open, map or read it.
    File(io::Error),
    /// It is no bank, or a damaged one.
    Bank(lipz_bank::Error),
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Error::File(error) => error.fmt(f),
            Error::Bank(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for Error {}

impl From<io::Error> for Error {
    fn from(error: io::Error) -> Error {
        Error::File(error)
    }
}

impl From<lipz_bank::Error> for Error {
    fn from(error: lipz_bank::Error) -> Error {
        Error::Bank(error)
    }
}
