//! The displayed text of a segment, and the source of its bytes.

use lipz_file::text::meta_ranges;
use std::ops::Range;

/// A segment without its `{meta}`.
#[derive(Debug)]
pub(super) struct Display {
    pub(super) text: String,
    /// For each stretch without meta: its position in `text`, and in the whole text.
    stretches: Vec<(usize, usize)>,
    /// The position of each meta in `text`, and the range of its content in the whole text.
    pub(super) metas: Vec<(usize, Range<usize>)>,
}

impl Display {
    /// Returns the display of the segment at `segment` of `whole`.
    pub(super) fn new(whole: &str, segment: Range<usize>) -> Display {
        let start = segment.start;
        let source = whole.get(segment).unwrap_or_default();
        let mut display =
            Display { text: String::with_capacity(source.len()), stretches: Vec::new(), metas: Vec::new() };
        let mut end = 0;
        let add = |display: &mut Display, range: Range<usize>| {
            display.stretches.push((display.text.len(), start + range.start));
            display.text.push_str(source.get(range).unwrap_or_default());
        };
        for meta in meta_ranges(source) {
            add(&mut display, end..meta.start);
            display.metas.push((display.text.len(), start + meta.start + 1..start + meta.end - 1));
            end = meta.end;
        }
        add(&mut display, end..source.len());
        display
    }

    /// Converts a range of the displayed text to one of the whole text. It includes metas inside, but not at its ends.
    pub(super) fn range(&self, range: &Range<usize>) -> Range<usize> {
        let place = |after: usize, at: usize| {
            let stretch = self.stretches.get(after.saturating_sub(1)).copied().unwrap_or_default();
            stretch.1 + (at - stretch.0)
        };
        let start = place(self.stretches.partition_point(|stretch| stretch.0 <= range.start), range.start);
        let end = place(self.stretches.partition_point(|stretch| stretch.0 < range.end.max(1)), range.end);
        start..end.max(start)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_lead_back_to_the_text() {
        let whole = "a|{x}He{m}llo{y} you{z}|b";
        let display = Display::new(whole, 2..23);
        assert_eq!(display.text, "Hello you");
        assert_eq!(&whole[display.range(&(0..5))], "He{m}llo");
        assert_eq!(&whole[display.range(&(6..9))], "you");
        assert_eq!(&whole[display.range(&(0..2))], "He");
        assert_eq!(&whole[display.range(&(2..5))], "llo");
        let contents: Vec<_> = display.metas.iter().map(|(at, range)| (*at, &whole[range.clone()])).collect();
        assert_eq!(contents, [(0, "x"), (2, "m"), (5, "y"), (9, "z")]);
    }

    #[test]
    fn a_segment_of_nothing_has_ranges_too() {
        assert_eq!(Display::new("", 0..0).range(&(0..0)), 0..0);
        assert_eq!(Display::new("{x}", 0..3).range(&(0..0)), 3..3);
    }
}
