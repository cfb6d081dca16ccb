//! Why files do not make a dialogue.

use crate::Error;
use core::fmt;

/// Why files do not make a [`Dialogue`](crate::Dialogue): an error, and the file that has it.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct DialogueError {
    file: usize,
    error: Error,
}

impl DialogueError {
    /// The error of the file with this number.
    pub const fn new(file: usize, error: Error) -> DialogueError {
        DialogueError { file, error }
    }

    /// The number of the file that is damaged or does not fit those before it, from 0.
    pub const fn file(self) -> usize {
        self.file
    }

    /// The error of that file.
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
