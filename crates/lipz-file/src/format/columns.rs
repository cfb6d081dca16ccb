//! Columns: the spaces that align the `|` of all elements.

use crate::text::DELIMITER;
use unicode_segmentation::UnicodeSegmentation;
use unicode_width::UnicodeWidthStr;

/// The columns after the opening quote in which `|` are aligned. Readers rarely scroll further, and with long segments
/// in many locales, spaces would make up most of the file.
const ALIGNED_COLUMNS: usize = 500;

/// The segments of one element, as spelled.
pub(super) struct SegmentRow {
    segments: Vec<String>,
    is_padded: bool,
}

impl SegmentRow {
    /// Returns a row whose segments may be padded.
    pub(super) fn padded(segments: Vec<String>) -> SegmentRow {
        SegmentRow { segments, is_padded: true }
    }

    /// Returns a row without spaces: visemes.
    pub(super) fn fixed(segments: Vec<String>) -> SegmentRow {
        SegmentRow { segments, is_padded: false }
    }

    /// Returns the row as a JSON string.
    pub(super) fn literal(self) -> String {
        let delimiter = DELIMITER.to_string();
        format!("\"{}\"", self.segments.join(&delimiter))
    }
}

/// Adds spaces to the ends of segments. The first `|` of all rows go to the leftmost column that all of them reach, and
/// likewise the second ones, and so on. This includes those of a fixed row, unless another row needs more columns.
/// Later ones are aligned again when the fixed row has caught up.
pub(super) fn align(rows: &mut [SegmentRow]) {
    let mut starts = vec![0; rows.len()];
    for index in 0.. {
        let ends: Vec<Option<usize>> = std::iter::zip(&*rows, &starts)
            .map(|(row, start)| {
                // The last segment ends with the quote, which needs no alignment.
                row.segments.get(index + 1)?;
                Some(start + width(row.segments.get(index)?))
            })
            .collect();
        let Some(column) = ends.iter().copied().flatten().max().filter(|column| *column <= ALIGNED_COLUMNS) else {
            return;
        };
        for ((row, start), end) in std::iter::zip(&mut *rows, &mut starts).zip(ends) {
            let (Some(end), Some(segment)) = (end, row.segments.get_mut(index)) else { continue };
            let blanks = if row.is_padded { column - end } else { 0 };
            segment.extend(std::iter::repeat_n(' ', blanks));
            *start = end + blanks + 1;
        }
    }
}

/// Returns the columns of a text in an editor: one or two for each visible character. Counts characters separately,
/// because the width of the whole would join Arabic letters that fixed-width fonts keep apart.
fn width(text: &str) -> usize {
    if text.is_ascii() { text.len() } else { text.graphemes(true).map(UnicodeWidthStr::width).sum() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn aligned(visemes: &str, others: &[&str]) -> Vec<String> {
        let segments = |text: &str| text.split(DELIMITER).map(str::to_owned).collect();
        let mut rows = vec![SegmentRow::fixed(segments(visemes))];
        rows.extend(others.iter().map(|text| SegmentRow::padded(segments(text))));
        align(&mut rows);
        rows.into_iter().map(SegmentRow::literal).collect()
    }

    #[test]
    fn under_the_visemes() {
        assert_eq!(
            aligned("AAAAAA|---|A", &["Ha|ha|", "||x"]),
            [r#""AAAAAA|---|A""#, r#""Ha    |ha |""#, r#""      |   |x""#]
        );
    }

    #[test]
    fn visemes_that_are_shorter_meet_the_others_again() {
        assert_eq!(
            aligned("A|AAAAAAA|-", &["Hello|you|", "Aye  |Aye|!"]),
            [r#""A|AAAAAAA|-""#, r#""Hello|you|""#, r#""Aye  |Aye|!""#]
        );
        assert_eq!(
            aligned("A|AAAAAAAA|-", &["Hello|you|", "Aye|Aye|!"]),
            [r#""A|AAAAAAAA|-""#, r#""Hello|you |""#, r#""Aye  |Aye |!""#]
        );
    }

    #[test]
    fn wide_characters_combining_marks_and_escapes() {
        assert_eq!(
            aligned("A|", &["灯台|", "שָׁלוֹם|", "e\u{301}|", "\\u00a0|", "👩‍🚀|"]),
            ["\"A|\"", "\"灯台  |\"", "\"שָׁלוֹם  |\"", "\"e\u{301}     |\"", "\"\\u00a0|\"", "\"👩‍🚀    |\"",]
        );
    }

    #[test]
    fn rows_of_other_lengths() {
        assert_eq!(aligned("A", &["x|yy|z", "xx", "xx|y"]), [r#""A""#, r#""x |yy|z""#, r#""xx""#, r#""xx|y""#]);
    }

    #[test]
    fn far_to_the_side_nothing_is_aligned() {
        let long = "A".repeat(ALIGNED_COLUMNS);
        let text = |blanks: usize| format!("\"x{}|y|z\"", " ".repeat(blanks));
        assert_eq!(aligned(&format!("{long}|AA|"), &["x|y|z"])[1], text(ALIGNED_COLUMNS - 1));
        assert_eq!(aligned(&format!("A{long}|AA|"), &["x|y|z"])[1], text(0));
    }
}
