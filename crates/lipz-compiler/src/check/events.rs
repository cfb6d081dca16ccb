//! The event strings of a clip's segments.

use super::texts::nul;
use lipz::JsonString;
use lipz::{Code, Diagnostic, text};

/// The trimmed event string of each segment.
pub(super) fn trimmed(string: &JsonString<'_>, diagnostics: &mut Vec<Diagnostic>) -> Vec<Box<str>> {
    nul(string, Code::NulInEvents, "the events contain", diagnostics);
    text::segments(&string.text).map(|range| text::trim(&string.text[range]).into()).collect()
}
