//! The lines of a cue after its times.

use crate::source::Line;
use lipz_diagnostics::Span;
use std::ops::Range;

/// The lines of a cue after its times.
pub(super) struct Body<'t>(Vec<Line<'t>>);

impl<'t> Body<'t> {
    pub(super) fn new(lines: &[Line<'t>]) -> Body<'t> {
        Body(lines.to_vec())
    }

    /// Returns the text of all lines.
    pub(super) fn text(&self) -> String {
        self.0.iter().map(|line| line.text).collect::<Vec<_>>().join("\n")
    }

    /// Returns the position in the file of a part of the text, up to the end of its first line.
    pub(super) fn span(&self, part: Range<usize>) -> Span {
        let mut start = 0;
        for line in &self.0 {
            let end = start + line.text.len();
            if part.start < end {
                return Span::new(line.at + part.start - start, line.at + part.end.min(end) - start);
            }
            start = end + 1;
        }
        Span::default()
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn parts_of_a_text_are_found_in_the_file() {
        let file = "Gute\r\nfrüh <b\r\n>!\r\n";
        let body = Body::new(&crate::source::lines(file).collect::<Vec<_>>());
        let text = body.text();
        for (part, in_file) in [("Gute", "Gute"), ("üh", "üh"), ("<b\n>", "<b"), ("!", "!")] {
            let at = text.find(part).unwrap();
            assert_eq!(&file[body.span(at..at + part.len()).range()], in_file);
        }
    }
}
