//! Fallout 2: LIP files of its talking heads, and what belongs to them.

pub mod lip;
mod phonemes;

use lipz::{Code, Diagnostic, Span};
use std::ops::Range;

/// Findings of one kind that a file can have; the others are counted.
const LISTED: usize = 100;

/// A finding about these bytes of a file that is not text.
fn place(code: Code, range: Range<usize>, headline: impl Into<String>) -> Diagnostic {
    Diagnostic::at(code, Span::new(range.start, range.end), headline)
}

/// Adds the first findings of one kind, and counts the others in a note of the last: a damaged file
/// can have millions.
fn list(found: &mut Vec<Diagnostic>, mut findings: impl Iterator<Item = Diagnostic>) {
    found.extend(findings.by_ref().take(LISTED));
    let more = findings.count();
    if let Some(last) = found.last_mut().filter(|_| more > 0) {
        last.notes.push(format!("{more} more like this are not listed"));
    }
}
