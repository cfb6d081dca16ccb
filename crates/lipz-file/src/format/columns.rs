//! Columns: which blanks bring the `|` of all elements under each other.

use crate::text::DELIMITER;
use unicode_segmentation::UnicodeSegmentation;
use unicode_width::UnicodeWidthStr;

/// Columns from the opening quote up to which `|` are aligned: nobody reads further to the side,
/// and with long segments in many locales blanks would make up most of the file.
const ALIGNED_COLUMNS: usize = 500;

/// The segments of one element, as they are spelled.
pub(super) struct Row {
    segments: Vec<String>,
    is_padded: bool,
}

impl Row {
    /// A row to whose segments blanks are added.
    pub(super) fn padded(segments: Vec<String>) -> Row {
        Row { segments, is_padded: true }
    }

    /// A row without spaces: visemes.
    pub(super) fn fixed(segments: Vec<String>) -> Row {
        Row { segments, is_padded: false }
    }

    /// The row as a JSON string.
    pub(super) fn literal(self) -> String {
        let delimiter = DELIMITER.to_string();
        format!("\"{}\"", self.segments.join(&delimiter))
    }
}

/// Adds spaces to the ends of segments. The first `|` of all rows stand in the leftmost column that
/// all of them reach, so do the second ones, and so on. Those of a fixed row stand there, too,
/// unless another row needs more columns; they meet again where the fixed row has caught up.
pub(super) fn align(rows: &mut [Row]) {
    let mut starts = vec![0; rows.len()];
    for index in 0.. {
        let ends: Vec<Option<usize>> = std::iter::zip(&*rows, &starts)
            .map(|(row, start)| {
                // The last segment ends with the quote, which nobody needs in a column.
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

/// Columns of a text in an editor: each character that a reader sees has one or two. Character by
/// character, because the width of the whole would join Arabic letters that fixed-width fonts keep
/// apart.
fn width(text: &str) -> usize {
    if text.is_ascii() { text.len() } else { text.graphemes(true).map(UnicodeWidthStr::width).sum() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn aligned(visemes: &str, others: &[&str]) -> Vec<String> {
        let segments = |text: &str| text.split(DELIMITER).map(str::to_owned).collect();
        let mut rows = vec![Row::fixed(segments(visemes))];
        rows.extend(others.iter().map(|text| Row::padded(segments(text))));
        align(&mut rows);
        rows.into_iter().map(Row::literal).collect()
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
