//! The error for files that do not form a dialogue.

use crate::Error;
use core::fmt;

/// Why files do not form a [`Dialogue`](crate::Dialogue): an error and the number of the file.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct DialogueError {
    file: usize,
    error: Error,
}

impl DialogueError {
    /// Returns an error in the file with this number.
    pub const fn new(file: usize, error: Error) -> DialogueError {
        DialogueError { file, error }
    }

    /// Returns the number, from 0, of the file that is damaged or does not match those before it.
    pub const fn file(self) -> usize {
        self.file
    }

    /// Returns the error in that file.
    pub const fn error(self) -> Error {
        self.error
    }
}

impl fmt::Display for DialogueError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "file {}: {}", self.file, self.error)
    }
}

#[cfg(feature = "std")]
impl std::error::Error for DialogueError {}
