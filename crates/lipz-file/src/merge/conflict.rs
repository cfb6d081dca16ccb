//! A merged file with conflicts, in canonical layout.

use super::elements::{MergedElement, document};
use crate::format::{LineEnding, Style, format};
use crate::parse;
use std::collections::HashMap;

/// The lines of an element.
type Lines<'t> = Vec<&'t str>;

/// Returns the file with both versions of each conflict, between markers.
pub(super) fn text(merged: &[MergedElement<'_>], style: Style<'_>) -> Option<String> {
    // Both texts have all elements in the same order. An element that one side lacks has the value of the other.
    let ours = format(&document(merged, MergedElement::ours_first), style);
    let theirs = format(&document(merged, MergedElement::theirs_first), style);
    let by_name: HashMap<&str, &MergedElement<'_>> =
        merged.iter().map(|element| (element.name.as_str(), element)).collect();
    let (ours, theirs) = (element_lines(&ours)?, element_lines(&theirs)?);
    let mut lines: Lines<'_> = vec!["{"];
    for ((name, our), (_, their)) in ours.into_iter().zip(theirs) {
        let element = by_name.get(name.as_str())?;
        if !element.is_conflict() {
            lines.extend(our);
            continue;
        }
        lines.push("<<<<<<< ours");
        lines.extend(our.into_iter().filter(|_| element.ours.is_some()));
        lines.push("=======");
        lines.extend(their.into_iter().filter(|_| element.theirs.is_some()));
        lines.push(">>>>>>> theirs");
    }
    lines.push("}");
    let line_ending = if style.line_ending == LineEnding::CrLf { "\r\n" } else { "\n" };
    Some(lines.into_iter().flat_map(|line| [line, line_ending]).collect())
}

/// Returns the elements of a text in canonical layout, each with its lines.
fn element_lines(text: &str) -> Option<Vec<(String, Lines<'_>)>> {
    let document = parse(text.as_bytes()).document?;
    let lines = |element: &crate::Element<'_>| {
        let start = text.get(..element.name.span().range().start)?.rfind('\n').map_or(0, |before| before + 1);
        let end = element.value.span().range().end;
        let end = end + text.get(end..)?.find(['\r', '\n'])?;
        Some((element.name.text.to_string(), text.get(start..end)?.lines().collect()))
    };
    document.elements.iter().map(lines).collect()
}
