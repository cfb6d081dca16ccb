//! The error for an unknown name.

use core::fmt;

/// The error for a string that is not a name of the type it was parsed as.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[non_exhaustive]
pub struct UnknownName {
    /// The type that was expected, `viseme type`.
    pub kind: &'static str,
    /// The accepted names.
    pub expected: &'static str,
}

impl UnknownName {
    pub(crate) const fn new(kind: &'static str, expected: &'static str) -> UnknownName {
        UnknownName { kind, expected }
    }
}

impl fmt::Display for UnknownName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "unknown {}; expected {}", self.kind, self.expected)
    }
}

#[cfg(feature = "std")]
impl std::error::Error for UnknownName {}
