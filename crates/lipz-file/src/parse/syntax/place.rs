//! The place of a syntax error, and what stands around it.

use lipz_diagnostics::Span;

/// White space as JSON has it.
pub(super) const WHITE_SPACE: [char; 4] = [' ', '\t', '\r', '\n'];

/// Characters of a word or name that are looked at: messages show no longer ones, and hostile files
/// cannot make it slow.
const WORD_LIMIT: usize = 40;

/// The place of a syntax error.
pub(super) struct Place<'s> {
    text: &'s str,
    /// Byte offset of the character that serde_json did not expect.
    offset: usize,
}

impl<'s> Place<'s> {
    /// serde_json reports line and column (in bytes) just after the byte that it did not expect.
    pub(super) fn new(text: &'s str, error: &serde_json::Error) -> Place<'s> {
        let line_start = match error.line() {
            0 | 1 => 0,
            line => text.match_indices('\n').nth(line - 2).map_or(text.len(), |(at, _)| at + 1),
        };
        let mut offset = (line_start + error.column()).saturating_sub(1).min(text.len());
        while !text.is_char_boundary(offset) {
            offset -= 1;
        }
        Place { text, offset }
    }

    /// The place of the next character. serde_json does not count the control character that it
    /// stopped at as read.
    pub(super) fn next(&self) -> Place<'s> {
        Place { text: self.text, offset: self.character_span().end as usize }
    }

    /// The text from the place on.
    pub(super) fn rest(&self) -> &'s str {
        self.text.get(self.offset..).unwrap_or_default()
    }

    /// The text up to the place.
    pub(super) fn start(&self) -> &'s str {
        self.text.get(..self.offset).unwrap_or_default()
    }

    pub(super) fn character(&self) -> Option<char> {
        self.rest().chars().next()
    }

    pub(super) fn character_span(&self) -> Span {
        self.span_of(self.character().map_or(0, char::len_utf8))
    }

    /// So many bytes from the place on.
    pub(super) fn span_of(&self, length: usize) -> Span {
        Span::new(self.offset, self.offset + length)
    }

    /// What is there.
    pub(super) fn text_of(&self, span: Span) -> Option<&'s str> {
        self.text.get(span.range())
    }

    /// Where the last character before the place that is not white space is, and what it is.
    pub(super) fn before(&self) -> Option<(Span, char)> {
        let before = self.start().trim_end_matches(WHITE_SPACE);
        let (at, character) = before.char_indices().next_back()?;
        Some((Span::new(at, before.len()), character))
    }

    /// The word of such characters at or after the place, and where it is.
    pub(super) fn word(&self, belongs: impl Fn(char) -> bool) -> Option<(Span, &'s str)> {
        let before: usize =
            self.start().chars().rev().take(WORD_LIMIT).take_while(|&c| belongs(c)).map(char::len_utf8).sum();
        let after: usize = self.rest().chars().take(WORD_LIMIT).take_while(|&c| belongs(c)).map(char::len_utf8).sum();
        let span = Span::new(self.offset - before, self.offset + after);
        let word = self.text_of(span)?;
        (!word.is_empty()).then_some((span, word))
    }
}

/// Whether the text starts as an element does: `"name":`.
pub(super) fn starts_element(text: &str) -> bool {
    text.strip_prefix('"').is_some_and(starts_inside_name)
}

/// Whether the text goes on as an element does whose opening quote is gone: `name":`.
pub(super) fn starts_inside_name(text: &str) -> bool {
    let is_name = |c: char| c.is_alphanumeric() || matches!(c, '_' | '-');
    let name: usize = text.chars().take(WORD_LIMIT).take_while(|&c| is_name(c)).map(char::len_utf8).sum();
    let rest = text.get(name..).and_then(|rest| rest.strip_prefix('"'));
    name > 0 && rest.is_some_and(|rest| rest.trim_start_matches(WHITE_SPACE).starts_with(':'))
}
