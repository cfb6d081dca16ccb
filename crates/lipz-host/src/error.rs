//! Why a file is not used as a bank.

use std::{fmt, io};

/// Why a file is not used as a bank.
#[derive(Debug)]
#[non_exhaustive]
pub enum OpenError {
    /// The system cannot open, read or map the file.
    File(io::Error),
    /// It is no bank, or a damaged one.
    Bank(lipz_bank::Error),
    /// The banks are not those of the set.
    Set(lipz_bank::BankSetError),
}

impl fmt::Display for OpenError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            OpenError::File(error) => error.fmt(f),
            OpenError::Bank(error) => error.fmt(f),
            OpenError::Set(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for OpenError {}

impl From<io::Error> for OpenError {
    fn from(error: io::Error) -> OpenError {
        OpenError::File(error)
    }
}

impl From<lipz_bank::Error> for OpenError {
    fn from(error: lipz_bank::Error) -> OpenError {
        OpenError::Bank(error)
    }
}

impl From<lipz_bank::BankSetError> for OpenError {
    fn from(error: lipz_bank::BankSetError) -> OpenError {
        OpenError::Set(error)
    }
}
