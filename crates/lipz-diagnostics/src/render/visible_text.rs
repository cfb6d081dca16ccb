//! Excerpts in which every character is visible after rendering.
//!
//! The renderer shows ASCII control characters as symbols. It passes on those from U+0080 to U+009F, although a
//! terminal may interpret U+009B as the start of a command. It replaces direction marks by `�`, and drops U+200D,
//! without which a family of emoji falls apart.

use crate::{Diagnostic, escape};
use std::borrow::Cow;
use std::ops::Range;

const JOINER: char = '\u{200D}';

/// Characters without width that the renderer passes on, and that hardly any text contains.
const STAND_INS: [char; 5] = ['\u{2060}', '\u{2061}', '\u{2062}', '\u{2063}', '\u{2064}'];

/// Converts the text of a diagnostic for the renderer.
pub(super) struct VisibleText {
    /// The replacement of U+200D during rendering.
    stand_in: Option<char>,
}

impl VisibleText {
    /// Prepares excerpts of `source` for this diagnostic.
    pub(super) fn new(source: &str, diagnostic: &Diagnostic) -> VisibleText {
        if !source.contains(JOINER) {
            return VisibleText { stand_in: None };
        }
        let words = diagnostic.to_string();
        let labels = diagnostic.primary.iter().chain(&diagnostic.labels);
        let is_free = |c: &&char| {
            !source.contains(**c) && !words.contains(**c) && labels.clone().all(|label| !label.text.contains(**c))
        };
        VisibleText { stand_in: STAND_INS.iter().find(is_free).copied() }
    }

    /// Whether the renderer gets a different text from this, and therefore counts columns wrongly.
    pub(super) fn replaces(&self, excerpt: &str) -> bool {
        excerpt.contains(|c| self.is_replaced(c))
    }

    /// Returns an excerpt for the renderer.
    pub(super) fn text<'t>(&self, excerpt: &'t str) -> Cow<'t, str> {
        if !self.replaces(excerpt) {
            return Cow::Borrowed(excerpt);
        }
        let mut text = String::with_capacity(excerpt.len() + 16);
        for c in excerpt.chars() {
            match (c, self.stand_in) {
                (JOINER, Some(stand_in)) => text.push(stand_in),
                _ if self.is_replaced(c) => text.push_str(&escape::text(c.encode_utf8(&mut [0; 4]))),
                _ => text.push(c),
            }
        }
        Cow::Owned(text)
    }

    /// Returns the range of a mark in the text for the renderer.
    pub(super) fn place(&self, excerpt: &str, mark: Range<usize>) -> Range<usize> {
        let [start, end] = [mark.start, mark.end].map(|place| self.text(&excerpt[..place]).len());
        start..end
    }

    /// Returns the rendered text with the original characters.
    pub(super) fn restored(&self, rendered: String) -> String {
        match self.stand_in {
            Some(stand_in) => rendered.replace(stand_in, JOINER.encode_utf8(&mut [0; 4])),
            None => rendered,
        }
    }

    fn is_replaced(&self, c: char) -> bool {
        (c == JOINER && self.stand_in.is_some()) || (!c.is_ascii() && escape::steers(c))
    }
}

#[cfg(test)]
mod tests {
    use crate::{Code, Diagnostic, Report, Source, Span, render};

    #[test]
    fn what_cannot_be_seen_is_named_and_emoji_stay_whole() {
        let text = "\u{9b}\u{202e} 👨\u{200d}👧 \u{2060}X";
        let start = text.len() - 1;
        let found = Diagnostic::at(Code::ForeignCode, Span::new(start, start + 1), "odd");
        let shown = render::human(&[Report::new(Source::new("a", text), vec![found])]);
        let lines: Vec<&str> = shown.lines().collect();
        assert_eq!(lines[3], "1 | \\u009B\\u202E 👨\u{200d}👧 \u{2060}X");
        assert_eq!(lines[4], "  |                   ^", "under the X: four columns are emoji");
    }
}
