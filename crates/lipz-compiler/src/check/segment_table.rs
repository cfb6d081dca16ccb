//! A table of two elements with different numbers of segments, around the position where they diverge.

use lipz_diagnostics::escape;
use lipz_file::{JsonString, text};
use std::ops::Range;
use unicode_width::UnicodeWidthStr;

/// The maximum number of segments in the table; the rest are counted.
const SHOWN: usize = 12;
/// Rows to show after the end of the shorter element.
const SHOWN_ALONE: usize = 2;
/// Columns to show of a segment.
const WIDTH: usize = 36;
/// The length to which both elements are scaled, so that the positions of their segments can be compared.
const WHOLE: u64 = 1 << 20;

/// An element with its segments.
struct SegmentColumn<'d> {
    name: &'d str,
    text: &'d str,
    segments: Vec<Range<usize>>,
}

impl<'d> SegmentColumn<'d> {
    fn new((name, string): (&'d str, &'d JsonString<'d>)) -> SegmentColumn<'d> {
        SegmentColumn { name, text: &string.text, segments: text::segments(&string.text).collect() }
    }

    /// The lengths of the segments as parts of [`WHOLE`].
    fn parts(&self) -> Vec<u64> {
        let lengths = self.segments.iter().map(|range| text::trim(&self.text[range.clone()]).chars().count() as u64);
        let sum = lengths.clone().sum::<u64>().max(1);
        lengths.map(|length| length * WHOLE / sum).collect()
    }

    /// Returns the name, then the segments of these rows.
    fn cells(&self, rows: Range<usize>) -> Vec<String> {
        let segments = rows.map(|row| match self.segments.get(row) {
            Some(range) => cell(&self.text[range.clone()]),
            None => "(none)".to_owned(),
        });
        std::iter::once(self.name.to_owned()).chain(segments).collect()
    }
}

/// Returns a note for each row of a table of both elements. The first row has their names. Notes before and after the
/// table state the number of hidden segments.
pub(super) fn side_by_side<'d>(
    left: (&'d str, &'d JsonString<'d>),
    right: (&'d str, &'d JsonString<'d>),
) -> Vec<String> {
    let [left, right] = [left, right].map(SegmentColumn::new);
    let (a, b) = (left.segments.len(), right.segments.len());
    let rows = a.max(b).min(a.min(b) + SHOWN_ALONE);
    let first = match rows <= SHOWN {
        true => 0,
        false => parting(&left.parts(), &right.parts()).saturating_sub(SHOWN / 2).min(rows - SHOWN),
    };
    let last = rows.min(first + SHOWN);
    let (left, right) = (left.cells(first..last), right.cells(first..last));
    let width = left.iter().map(|cell| cell.width()).max().unwrap_or(0);
    let numbers = std::iter::once(String::new()).chain((first..last).map(|row| (row + 1).to_string()));
    let table = std::iter::zip(numbers, std::iter::zip(&left, &right)).map(|(number, (left, right))| {
        let blanks = " ".repeat(width.saturating_sub(left.width()));
        format!("{number:>2}  {left}{blanks}  {right}")
    });
    let before = hidden(first, "", " before these");
    let behind = hidden(a.max(b) - last, "more ", "");
    before.into_iter().chain(table).chain(behind).collect()
}

/// Returns the note about hidden segments, if there are any.
fn hidden(count: usize, more: &str, place: &str) -> Option<String> {
    match count {
        0 => None,
        1 => Some(format!("1 {more}segment{place} is not shown")),
        _ => Some(format!("{count} {more}segments{place} are not shown")),
    }
}

/// Returns the index of the segment in the shorter element that best fits several segments of the longer one, together
/// with the lengths of the segments before and after it. At this position, a `|` is missing or extra.
fn parting(a: &[u64], b: &[u64]) -> usize {
    let (long, short) = if a.len() < b.len() { (b, a) } else { (a, b) };
    let surplus = long.len() - short.len();
    let misfits = |shift: usize| std::iter::zip(short, long.iter().skip(shift)).map(|(a, b)| a.abs_diff(*b));
    let (mut before, mut behind) = (0, misfits(surplus).sum::<u64>());
    let mut joined: u64 = long.iter().take(surplus).sum();
    let mut best = (u64::MAX, 0);
    let places = std::iter::zip(short, std::iter::zip(misfits(0), misfits(surplus)));
    for (place, (part, (ahead, back))) in places.enumerate() {
        joined += long.get(place + surplus).copied().unwrap_or_default();
        behind -= back;
        best = best.min((before + part.abs_diff(joined) + behind, place));
        before += ahead;
        joined -= long.get(place).copied().unwrap_or_default();
    }
    best.1
}

/// Returns the start of a segment that fits into a cell.
fn cell(segment: &str) -> String {
    let mut cell = String::new();
    for character in text::trim(segment).chars() {
        if cell.width() >= WIDTH {
            cell.push('…');
            break;
        }
        cell.push_str(&escape::text(character.encode_utf8(&mut [0; 4])));
    }
    format!("`{cell}`")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parting_of(a: &str, b: &str) -> usize {
        let parts = |text| SegmentColumn { name: "", text, segments: text::segments(text).collect() }.parts();
        parting(&parts(a), &parts(b))
    }

    #[test]
    fn the_segment_that_is_two_is_found() {
        let all = ["Aye.", "I told you so.", "No", "What is it that you want?", "Go!", "Now."];
        let long = all.join("|");
        for missing in 0..5 {
            let mut short = all.map(str::to_owned).to_vec();
            let behind = short.remove(missing + 1);
            short[missing].push_str(&behind);
            assert_eq!(parting_of(&long, &short.join("|")), missing);
            assert_eq!(parting_of(&short.join("|"), &long), missing);
        }
    }

    #[test]
    fn blank_elements_part_somewhere() {
        assert_eq!(parting_of("||||", "|"), 0);
        assert_eq!(parting_of("a|b", ""), 0);
    }
}
