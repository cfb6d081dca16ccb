//! The position of a syntax error, and the text around it.

use lipz_diagnostics::Span;

/// The whitespace characters of JSON.
pub(in crate::parse) const WHITE_SPACE: [char; 4] = [' ', '\t', '\r', '\n'];

/// The most characters of a word or name that are read. Messages show no longer ones, and the limit keeps hostile files
/// from being slow.
const WORD_LIMIT: usize = 40;

/// The position of a syntax error.
pub(in crate::parse) struct ErrorPosition<'s> {
    text: &'s str,
    /// Byte offset of the unexpected character.
    offset: usize,
    /// End of the previous token: whitespace and comments are between them.
    before: usize,
}

impl<'s> ErrorPosition<'s> {
    /// Returns the position of the character with this offset, after a token that ends at `before`.
    pub(in crate::parse) fn new(text: &'s str, offset: usize, before: usize) -> ErrorPosition<'s> {
        ErrorPosition { text, offset: text.floor_char_boundary(offset), before }
    }

    pub(super) fn offset(&self) -> usize {
        self.offset
    }

    /// Returns the text from the position on.
    pub(super) fn rest(&self) -> &'s str {
        self.text.get(self.offset..).unwrap_or_default()
    }

    /// Returns the text from a byte on.
    pub(super) fn behind(&self, offset: usize) -> &'s str {
        self.text.get(offset..).unwrap_or_default()
    }

    /// Returns the text up to the position.
    pub(super) fn start(&self) -> &'s str {
        self.text.get(..self.offset).unwrap_or_default()
    }

    pub(super) fn character(&self) -> Option<char> {
        self.rest().chars().next()
    }

    pub(super) fn character_span(&self) -> Span {
        self.span_of(self.character().map_or(0, char::len_utf8))
    }

    /// Returns a span of this length, from the position on.
    pub(super) fn span_of(&self, length: usize) -> Span {
        Span::new(self.offset, self.offset + length)
    }

    /// Returns the text of a span.
    pub(super) fn text_of(&self, span: Span) -> Option<&'s str> {
        self.text.get(span.range())
    }

    /// Returns the last character before the position, with its span.
    pub(super) fn before(&self) -> Option<(Span, char)> {
        let before = self.text.get(..self.before)?.trim_end_matches(WHITE_SPACE);
        let (at, character) = before.char_indices().next_back()?;
        Some((Span::new(at, before.len()), character))
    }

    /// Returns the word of accepted characters at or after the position, with its span.
    pub(super) fn word(&self, belongs: impl Fn(char) -> bool) -> Option<(Span, &'s str)> {
        let before: usize =
            self.start().chars().rev().take(WORD_LIMIT).take_while(|&c| belongs(c)).map(char::len_utf8).sum();
        let after: usize = self.rest().chars().take(WORD_LIMIT).take_while(|&c| belongs(c)).map(char::len_utf8).sum();
        let span = Span::new(self.offset - before, self.offset + after);
        let word = self.text_of(span)?;
        (!word.is_empty()).then_some((span, word))
    }
}

/// Whether the text starts like an element: `"name":`.
pub(in crate::parse) fn starts_element(text: &str) -> bool {
    text.strip_prefix('"').is_some_and(starts_inside_name)
}

/// Whether the text starts like an element without its opening quote: `name":`.
pub(super) fn starts_inside_name(text: &str) -> bool {
    let is_name = |c: char| c.is_alphanumeric() || matches!(c, '_' | '-');
    let name: usize = text.chars().take(WORD_LIMIT).take_while(|&c| is_name(c)).map(char::len_utf8).sum();
    let rest = text.get(name..).and_then(|rest| rest.strip_prefix('"'));
    name > 0 && rest.is_some_and(|rest| rest.trim_start_matches(WHITE_SPACE).starts_with(':'))
}

/// Whether the text starts like an element without quotes or with a different colon: `name =`.
pub(super) fn starts_bare_element(text: &str) -> bool {
    let is_quote = |c: char| matches!(c, '\'' | '"' | '‘' | '’' | '“' | '”' | '`');
    let is_name = |c: char| c.is_alphanumeric() || matches!(c, '_' | '-');
    let text = text.strip_prefix(is_quote).unwrap_or(text);
    let name: usize = text.chars().take(WORD_LIMIT).take_while(|&c| is_name(c)).map(char::len_utf8).sum();
    let rest = text.get(name..).unwrap_or_default();
    let rest = rest.strip_prefix(is_quote).unwrap_or(rest);
    name > 0 && rest.trim_start_matches([' ', '\t']).starts_with([':', '='])
}

/// Returns the start of the next element, or of a closing brace on a separate line, after a byte of the text.
pub(in crate::parse) fn find_element(text: &str, from: usize) -> Option<usize> {
    let mut at = from;
    loop {
        at += text.get(at..)?.find([',', '\n'])?;
        let is_comma = text.as_bytes().get(at) == Some(&b',');
        let rest = text.get(at + 1..)?;
        let next = rest.trim_start_matches(WHITE_SPACE);
        at += 1 + rest.len() - next.len();
        if starts_element(next) || (!is_comma && (next.starts_with('}') || starts_bare_element(next))) {
            return Some(at);
        }
    }
}
