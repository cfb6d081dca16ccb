//! An old and a new value.

/// An old and a new value.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "json", derive(serde::Serialize))]
pub struct Change<T> {
    /// In the old bank.
    pub old: T,
    /// In the new bank.
    pub new: T,
}

impl<T: PartialEq> Change<T> {
    /// Returns the change, if there is one.
    pub(super) fn between(old: T, new: T) -> Option<Change<T>> {
        (old != new).then_some(Change { old, new })
    }
}

impl<T> Change<T> {
    /// Applies a function to both values.
    pub fn map<U>(self, mut f: impl FnMut(T) -> U) -> Change<U> {
        Change { old: f(self.old), new: f(self.new) }
    }
}
