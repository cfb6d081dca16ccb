//! Compares every answer of a bank with expected ones, byte by byte and without std.
//!
//! The expected answers are a golden bank's `.dump`, the same file as in the tests of `lipz-bank`. The function that
//! writes the answers is also shared with them.

#![no_std]
#![forbid(unsafe_code)]

use core::fmt;
use lipz_bank::{Bank, Error};
use lipz_testkit::answers;

/// Why the answers of a bank differ from the expected ones.
#[derive(Clone, Copy, Debug)]
pub enum Failure<'a> {
    /// The bank was rejected.
    Refused(Error),
    /// An answer differs.
    Differs {
        /// Line of the expected answers, from 1.
        line: u32,
        /// The number of bytes at the start of the line that are as expected.
        equal_bytes: u32,
        /// The expected line, without its end; empty after the last one.
        expected: &'a str,
    },
}

impl Failure<'_> {
    /// Returns the line that differs, or 0 if the bank was rejected.
    pub fn line(&self) -> u32 {
        match self {
            Failure::Refused(_) => 0,
            Failure::Differs { line, .. } => *line,
        }
    }
}

impl fmt::Display for Failure<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Failure::Refused(error) => write!(f, "refused: {error}"),
            Failure::Differs { line, equal_bytes, expected } => {
                write!(f, "answer {line} differs behind byte {equal_bytes}; expected: {expected}")
            }
        }
    }
}

/// Opens and verifies the bank in `bytes`.
pub fn verified(bytes: &[u8]) -> Result<Bank<'_>, Failure<'_>> {
    Bank::open(bytes).and_then(Bank::verify).map_err(Failure::Refused)
}

/// Makes every query of `bank`: each frame, viseme by time, segment, event, and text in each locale.
pub fn answers_as<'a>(bank: &Bank<'_>, expected: &'a str) -> Result<(), Failure<'a>> {
    let mut comparison = Comparison { expected, equal_bytes: 0 };
    let is_written = answers::write_answers(bank, &mut comparison).is_ok();
    if is_written && comparison.equal_bytes == expected.len() { Ok(()) } else { Err(comparison.failure()) }
}

/// A sink that stops at the first unexpected byte.
struct Comparison<'a> {
    expected: &'a str,
    equal_bytes: usize,
}

impl fmt::Write for Comparison<'_> {
    fn write_str(&mut self, found: &str) -> fmt::Result {
        let rest = self.expected.as_bytes().get(self.equal_bytes..).unwrap_or(&[]);
        let equal = found.bytes().zip(rest).take_while(|(found, expected)| found == *expected).count();
        self.equal_bytes += equal;
        if equal == found.len() { Ok(()) } else { Err(fmt::Error) }
    }
}

impl<'a> Comparison<'a> {
    fn failure(&self) -> Failure<'a> {
        let mut start = 0;
        let mut number = 0;
        for line in self.expected.split_inclusive('\n') {
            number += 1;
            if start + line.len() > self.equal_bytes {
                let equal_bytes = (self.equal_bytes - start) as u32;
                return Failure::Differs { line: number, equal_bytes, expected: line.trim_end() };
            }
            start += line.len();
        }
        Failure::Differs { line: number + 1, equal_bytes: 0, expected: "" }
    }
}
