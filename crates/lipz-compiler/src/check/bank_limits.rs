//! The limits of a bank for one clip: the number of segments and the size of a text (docs/reference/bank-format.md,
//! "Limits").

use super::elements::Roles;
use crate::util::strings::Strings;
use lipz_diagnostics::{Code, Diagnostic};
use lipz_file::{JsonString, text};
use lipz_layout::TEXT_MAX_BYTES;

/// The maximum number of segments in a clip.
const MOST_SEGMENTS: usize = u16::MAX as usize;

/// Reports the first display text of an element that is too long for a bank.
pub(super) fn for_texts(string: &JsonString<'_>, displays: &Strings, diagnostics: &mut Vec<Diagnostic>) {
    let Some((segment, display)) = displays.iter().enumerate().find(|(_, display)| display.len() > TEXT_MAX_BYTES)
    else {
        return;
    };
    let span = text::segments(&string.text).nth(segment).map_or(string.span(), |range| string.span_of(range));
    let message =
        format!("the text of a segment has {} bytes, but a bank stores at most {TEXT_MAX_BYTES}", display.len());
    diagnostics.push(Diagnostic::at(Code::BankTooLarge, span, message).help("split the segment with `|`"));
}

/// Reports a clip with too many segments for a bank, at the first excess segment.
pub(super) fn for_segments(roles: &Roles<'_>, count: usize, diagnostics: &mut Vec<Diagnostic>) {
    if count <= MOST_SEGMENTS {
        return;
    }
    let first_text = || roles.texts.first().map(|text| text.string);
    let Some(string) = roles.visemes.or_else(first_text).or(roles.events) else { return };
    let span = string.text.match_indices(text::DELIMITER).nth(MOST_SEGMENTS - 1).map(|(at, bar)| at..at + bar.len());
    let message = format!("the clip has {count} segments, but a bank stores at most {MOST_SEGMENTS}");
    let diagnostic = Diagnostic::at(Code::BankTooLarge, span.map_or(string.span(), |bar| string.span_of(bar)), message);
    diagnostics.push(diagnostic.help("split it into several clips"));
}
