//! Fallout 2: LIP files of its talking heads, and related files.
//!
//! [`lip`] contains the files without loss, [`units`] the units of their markers, [`msg`] the texts of the game, and
//! [`heads`] the animations. docs/guides/fallout-and-second-life.md describes all of them.

pub(crate) mod clip;
pub mod heads;
pub mod lip;
pub mod msg;
pub mod sound;
pub mod units;

use lipz_diagnostics::{Code, Diagnostic};
use std::ops::Range;

/// The last phoneme code that stands for a phone.
pub const LAST_PHONEME: u8 = 0x29;

/// The most diagnostics of one kind that are listed per file. The rest are counted.
const LISTED: usize = 100;

/// Returns a diagnostic about these bytes of a binary file.
fn place(code: Code, range: Range<usize>, message: impl Into<String>) -> Diagnostic {
    let diagnostic = Diagnostic::new(code, message);
    match range.end.saturating_sub(1) {
        last if last > range.start => diagnostic.note(format!("bytes {:#04x} to {last:#04x}", range.start)),
        _ => diagnostic.note(format!("byte {:#04x}", range.start)),
    }
}

/// Adds the first diagnostics of one kind, and counts the rest in a note of the last, because a damaged file can have
/// millions.
fn list(found: &mut Vec<Diagnostic>, mut diagnostics: impl Iterator<Item = Diagnostic>) {
    found.extend(diagnostics.by_ref().take(LISTED));
    let more = diagnostics.count();
    if let Some(last) = found.last_mut().filter(|_| more > 0) {
        last.notes.push(format!("{more} more like this are not listed"));
    }
}
