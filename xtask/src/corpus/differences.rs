//! What was found to differ: the first few in words, all in number.

use crate::Failure;

/// Differences that are printed.
const SHOWN: usize = 10;

/// Differences between what is expected and what is.
#[derive(Debug, Default)]
pub(super) struct Differences {
    first: Vec<String>,
    count: usize,
}

impl Differences {
    pub(super) fn add(&mut self, line: impl FnOnce() -> String) {
        self.count += 1;
        if self.first.len() < SHOWN {
            self.first.push(line());
        }
    }

    /// Adds a difference unless `found` is `expected`.
    #[allow(clippy::needless_pass_by_value)] // the values are made for the call
    pub(super) fn equal<T: PartialEq + std::fmt::Debug>(&mut self, key: &str, what: &str, found: T, expected: T) {
        if found != expected {
            self.add(|| format!("{key}: {what} is {found:?}, expected {expected:?}"));
        }
    }

    pub(super) fn count(&self) -> usize {
        self.count
    }

    /// Prints the first differences; fails if there are any.
    pub(super) fn conclude(self) -> Result<(), Failure> {
        for line in &self.first {
            println!("  {line}");
        }
        match self.count {
            0 => Ok(()),
            count => Err(format!("{count} differences, the first {} above", self.first.len())),
        }
    }
}
