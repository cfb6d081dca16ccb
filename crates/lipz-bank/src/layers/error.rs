//! Why banks do not make a stack.

use crate::Error;
use core::fmt;

/// Why [`Layers::new`](crate::Layers::new) refuses banks: the error, and which of them it is about.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct LayersError {
    layer: usize,
    error: Error,
}

impl LayersError {
    /// The error that the bank with this index has.
    pub const fn new(layer: usize, error: Error) -> LayersError {
        LayersError { layer, error }
    }

    /// Index of the bank that does not fit, 0 for the lowest.
    pub const fn layer(self) -> usize {
        self.layer
    }

    /// What is wrong with it.
    pub const fn error(self) -> Error {
        self.error
    }
}

impl fmt::Display for LayersError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "layer {}: {}", self.layer, self.error)
    }
}

#[cfg(feature = "std")]
impl std::error::Error for LayersError {}
