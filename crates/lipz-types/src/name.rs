//! The error for a name that means nothing.

use core::fmt;

/// A string is not the name of any value of the type it was parsed as.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[non_exhaustive]
pub struct UnknownName {
    /// What was asked for, `viseme type`.
    pub kind: &'static str,
    /// What would have been accepted.
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
