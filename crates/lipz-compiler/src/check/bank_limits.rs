//! What a bank has no room for in one clip: too many segments, and texts that are too long (docs/reference/bank-format.md, "Limits").

use super::elements::Roles;
use crate::strings::Strings;
use lipz_diagnostics::{Code, Diagnostic};
use lipz_file::{JsonString, text};
use lipz_layout::TEXT_MAX_BYTES;

/// The most segments of a clip.
const MOST_SEGMENTS: usize = u16::MAX as usize;

/// Reports the first of the display texts of an element for which there is no room.
pub(super) fn for_texts(string: &JsonString<'_>, displays: &Strings, diagnostics: &mut Vec<Diagnostic>) {
    let Some((segment, display)) = displays.iter().enumerate().find(|(_, display)| display.len() > TEXT_MAX_BYTES)
    else {
        return;
    };
    let span = text::segments(&string.text).nth(segment).map_or(string.span(), |range| string.span_of(range));
    let message = format!("the text of a segment has {} bytes; a bank has room for {TEXT_MAX_BYTES}", display.len());
    diagnostics.push(Diagnostic::at(Code::BankTooLarge, span, message).help("divide the segment with `|`"));
}

/// Reports that there is no room for so many segments, at the first one too many.
pub(super) fn for_segments(roles: &Roles<'_>, count: usize, diagnostics: &mut Vec<Diagnostic>) {
    if count <= MOST_SEGMENTS {
        return;
    }
    let first_text = || roles.texts.first().map(|text| text.string);
    let Some(string) = roles.visemes.or_else(first_text).or(roles.events) else { return };
    let span = string.text.match_indices(text::DELIMITER).nth(MOST_SEGMENTS - 1).map(|(at, bar)| at..at + bar.len());
    let message = format!("the clip has {count} segments; a bank has room for {MOST_SEGMENTS}");
    let diagnostic = Diagnostic::at(Code::BankTooLarge, span.map_or(string.span(), |bar| string.span_of(bar)), message);
    diagnostics.push(diagnostic.help("divide it into several clips"));
}
