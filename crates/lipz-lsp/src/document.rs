//! A file that is open in the editor: its current text and its diagnostics.

use crate::{halves, place, uri};
use lipz_diagnostics::{Diagnostic, Span};
use lsp_types::{TextDocumentContentChangeEvent, Uri};
use ropey::Rope;
use std::ops::Range;
use std::path::PathBuf;

/// An open file.
#[derive(Debug)]
pub(crate) struct Document {
    /// The URI in the editor.
    pub(crate) uri: Uri,
    /// Its path, if it is a file.
    pub(crate) path: Option<PathBuf>,
    /// The editor's version number of this text.
    pub(crate) version: i32,
    /// The text as a rope, for conversion of positions.
    pub(crate) rope: Rope,
    /// The text as a string, for all other uses.
    pub(crate) text: String,
    /// The diagnostics that only the check of the whole project finds, moved to their current positions.
    pub(crate) from_project: Vec<Diagnostic>,
    /// The displayed diagnostics.
    pub(crate) shown: Vec<Diagnostic>,
    /// Whether the text has changed since `shown` was computed.
    pub(crate) is_stale: bool,
}

impl Document {
    pub(crate) fn new(uri: Uri, version: i32, text: String) -> Document {
        Document {
            path: uri::path(uri.as_str()),
            uri,
            version,
            rope: Rope::from_str(&text),
            text,
            from_project: Vec::new(),
            shown: Vec::new(),
            is_stale: true,
        }
    }

    /// Applies the editor's changes to the text.
    pub(crate) fn change(&mut self, version: i32, changes: Vec<TextDocumentContentChangeEvent>) {
        for change in changes {
            let (bytes, text) = match change.range {
                Some(range) => self.with_halves(range, change.text),
                None => (0..self.rope.len_bytes(), change.text),
            };
            let characters = self.rope.byte_to_char(bytes.start)..self.rope.byte_to_char(bytes.end);
            let at = characters.start;
            self.rope.remove(characters);
            self.rope.insert(at, &text);
            self.from_project.iter_mut().for_each(|diagnostic| follow(diagnostic, &bytes, text.len()));
        }
        self.text = self.rope.to_string();
        self.version = version;
        self.is_stale = true;
    }

    /// Returns the bytes of a range, and the text for them. If the range starts or ends within a surrogate pair, the
    /// other half of the character stays, and is joined with a half next to it.
    fn with_halves(&self, range: lsp_types::Range, text: String) -> (Range<usize>, String) {
        let mut bytes = place::bytes(&self.rope, range);
        let character = |byte: usize| self.rope.get_char(self.rope.byte_to_char(byte));
        let halves_at = |position, byte: usize| {
            if place::is_within_character(&self.rope, position) { halves::of(character(byte)?) } else { None }
        };
        let high = halves_at(range.start, bytes.start).map(|(high, _)| high);
        let low = halves_at(range.end, bytes.end).map(|(_, low)| low);
        if low.is_some() {
            bytes.end += character(bytes.end).map_or(0, char::len_utf8);
        }
        if high.is_none() && low.is_none() && !text.contains(halves::is_half) {
            return (bytes, text);
        }
        // A half may stand next to the range since an earlier change.
        let before =
            bytes.start.checked_sub(1).and_then(character).filter(|before| high.is_none() && halves::is_half(*before));
        let after = character(bytes.end).filter(|after| low.is_none() && halves::is_half(*after));
        bytes.start -= before.map_or(0, char::len_utf8);
        bytes.end += after.map_or(0, char::len_utf8);
        (bytes, halves::between(before.or(high), &text, low.or(after)))
    }

    /// Returns the length of the byte order mark in bytes. The parser's positions count from its end.
    pub(crate) fn mark_bytes(&self) -> usize {
        self.text.len() - lipz_file::without_byte_order_mark(self.text.as_bytes()).len()
    }
}

/// Moves a diagnostic with the text after a change, and drops its fix, which applies to the old text only.
fn follow(diagnostic: &mut Diagnostic, changed: &Range<usize>, length: usize) {
    let moved = |at: u32| {
        let at = at as usize;
        if at <= changed.start { at } else { at.max(changed.end) - changed.end + changed.start + length }
    };
    let labels = diagnostic.primary.iter_mut().chain(&mut diagnostic.labels);
    labels.for_each(|label| label.span = Span::new(moved(label.span.start), moved(label.span.end)));
    diagnostic.retain_fixes(|_| false);
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use lipz_diagnostics::Code;
    use lsp_types::{Position, Range};
    use std::str::FromStr;

    fn change(range: Option<(u32, u32, u32, u32)>, text: &str) -> TextDocumentContentChangeEvent {
        let range = range.map(|(a, b, c, d)| Range::new(Position::new(a, b), Position::new(c, d)));
        TextDocumentContentChangeEvent { range, range_length: None, text: text.into() }
    }

    #[test]
    fn changes_are_made_one_after_the_other_and_diagnostics_follow() {
        let mut document = Document::new(Uri::from_str("untitled:a").unwrap(), 1, "{\n\"𝄞\": 1\n}".into());
        document.from_project = vec![Diagnostic::at(Code::EmptyFile, Span::new(10, 11), "")];
        document.change(2, vec![change(Some((1, 3, 1, 3)), "ü"), change(Some((0, 0, 0, 1)), "")]);
        assert_eq!(document.text, "\n\"𝄞ü\": 1\n}");
        let span = document.from_project[0].primary.as_ref().unwrap().span;
        assert_eq!(&document.text[span.range()], "1");
        document.change(3, vec![change(None, "{}"), change(Some((7, 0, 9, 9)), " ")]);
        assert_eq!((document.text.as_str(), document.version), ("{} ", 3));
    }

    /// The text of the editor, in UTF-16 units, is the same after any change of halves.
    #[test]
    fn halves_of_characters_are_replaced() {
        let mut document = Document::new(Uri::from_str("untitled:a").unwrap(), 1, "a\u{1f600}b".into());
        // U+1F600 is D83D DE00.
        document.change(2, vec![change(Some((0, 2, 0, 3)), "\u{f601}")]);
        assert_eq!(document.text, "a\u{1f601}b");
        document.change(3, vec![change(Some((0, 1, 0, 2)), ""), change(Some((0, 1, 0, 1)), "\u{f03c}")]);
        assert_eq!(document.text, "a\u{1f201}b");
        document.change(4, vec![change(Some((0, 2, 0, 2)), "x")]);
        assert_eq!(document.text, "a\u{f03c}x\u{f601}b");
        document.change(5, vec![change(Some((0, 4, 0, 5)), "c"), change(Some((0, 2, 0, 3)), "")]);
        assert_eq!(document.text, "a\u{f03c}\u{f601}c", "no half was sent");
        document.change(6, vec![change(Some((0, 1, 0, 2)), "\u{f03d}")]);
        assert_eq!(document.text, "a\u{1f601}c");
        document.change(7, vec![change(Some((0, 1, 0, 3)), "\u{f000}")]);
        assert_eq!(document.text, "a\u{f000}c", "a character of an icon font");
        for range in [None, Some((0, 0, 0, 3))] {
            document.change(8, vec![change(range, "\u{f03d}\u{f601}")]);
            assert_eq!(document.text, "\u{f03d}\u{f601}", "two characters of an icon font");
        }
    }
}
