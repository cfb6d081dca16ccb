//! The row of texts in one locale, below the frames of their segments.

use super::palette::{Palette, StyledRow};
use anstyle::Style;
use lipz_bank::{Locale, Segment};
use lipz_diagnostics::escape;
use std::ops::Range;
use unicode_segmentation::UnicodeSegmentation;
use unicode_width::UnicodeWidthStr;

/// Replaces text that does not fit.
const MORE: &str = "…";

/// The texts of a clip. A text begins below its segment and continues from band to band.
pub(super) struct TextLines {
    locale: Option<Locale>,
    palette: Palette,
    /// The rest of the text of the last segment.
    rest: Rest,
}

impl TextLines {
    /// Creates the row of the texts in this locale, if there is one.
    pub(super) fn new(locale: Option<Locale>, palette: Palette) -> TextLines {
        TextLines { locale, palette, rest: Rest::default() }
    }

    /// Writes the part of the text of `segment` that belongs below its frames `part` into the row of the band that
    /// begins at frame `first`.
    pub(super) fn put(&mut self, row: &mut StyledRow, segment: &Segment<'_>, part: &Range<usize>, first: usize) {
        let is_start = part.start == segment.start_frame() as usize;
        let is_end = part.end == segment.end_frame() as usize;
        if is_start {
            self.rest = self.locale.and_then(|locale| segment.text(locale)).map_or_else(Rest::default, |text| {
                let colour = self.palette.segment(segment.index());
                let style = if text.is_fallback() && colour != Style::new() { colour.italic() } else { colour };
                Rest { text: escape::text(text.as_str()).into_owned(), at: 0, style }
            });
        }
        // Leave a blank before the next text, if there is one.
        let is_last = segment.end_frame() == segment.clip().frame_count();
        let room = part.len() - usize::from(is_end && !is_last);
        let shown = self.rest.take(room, is_end);
        row.put(part.start - first, &shown, self.rest.style);
    }
}

/// A partly shown text.
#[derive(Default)]
struct Rest {
    text: String,
    /// The number of bytes already shown.
    at: usize,
    style: Style,
}

impl Rest {
    /// Returns as many words as fit into `room` columns. At the end of the segment, a word is cut and the rest left
    /// out.
    fn take(&mut self, room: usize, is_end: bool) -> String {
        let rest = self.text.get(self.at..).unwrap_or_default().trim_start();
        self.at = self.text.len() - rest.len();
        let whole = fitting(rest, room);
        let shown = match whole == rest.len() {
            true => rest.to_owned(),
            false if room == 0 => String::new(),
            false if is_end => format!("{}{MORE}", rest.get(..fitting(rest, room - 1)).unwrap_or_default().trim_end()),
            false => {
                let fits = rest.get(..whole).unwrap_or_default();
                let is_between_words = rest.get(whole..).is_some_and(|next| next.starts_with(' '));
                let words = fits.rfind(' ').filter(|_| !is_between_words);
                fits.get(..words.unwrap_or(whole)).unwrap_or_default().to_owned()
            }
        };
        self.at += shown.len().min(rest.len());
        shown
    }
}

/// Returns the length in bytes of the longest prefix of `text` that fits into `room` columns.
pub(super) fn fitting(text: &str, room: usize) -> usize {
    let mut columns = 0;
    let fits = |cluster: &&str| {
        columns += cluster.width();
        columns <= room
    };
    text.graphemes(true).take_while(fits).map(str::len).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(text: &str, rooms: &[usize]) -> Vec<String> {
        let mut rest = Rest { text: text.into(), ..Rest::default() };
        rooms.iter().enumerate().map(|(index, &room)| rest.take(room, index + 1 == rooms.len())).collect()
    }

    #[test]
    fn texts_flow_on_at_words() {
        assert_eq!(shown("one two three", &[8, 20]), ["one two", "three"]);
        assert_eq!(shown("one two three", &[7, 20]), ["one two", "three"]);
        assert_eq!(shown("one two three", &[6, 4, 20]), ["one", "two", "three"]);
        assert_eq!(shown("incomprehensible", &[6, 20]), ["incomp", "rehensible"], "a word that is too long is cut");
        assert_eq!(shown("one two three", &[5]), ["one…"]);
        assert_eq!(shown("one", &[20, 20]), ["one", ""]);
        assert_eq!(shown("one", &[0]), [""]);
        assert_eq!(shown("日本語", &[3, 3]), ["日", "本…"], "wide characters are not halved");
        assert_eq!(shown("👨\u{200d}👩\u{200d}👧 ja", &[2, 3]), ["👨\u{200d}👩\u{200d}👧", "ja"], "nor families");
    }
}
