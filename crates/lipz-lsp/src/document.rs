//! A file that is open in the editor: its current text and its diagnostics.

use crate::{place, uri};
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
            let bytes = match change.range {
                Some(range) => place::bytes(&self.rope, range),
                None => 0..self.rope.len_bytes(),
            };
            let characters = self.rope.byte_to_char(bytes.start)..self.rope.byte_to_char(bytes.end);
            let at = characters.start;
            self.rope.remove(characters);
            self.rope.insert(at, &change.text);
            self.from_project.iter_mut().for_each(|diagnostic| follow(diagnostic, &bytes, change.text.len()));
        }
        self.text = self.rope.to_string();
        self.version = version;
        self.is_stale = true;
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
}
