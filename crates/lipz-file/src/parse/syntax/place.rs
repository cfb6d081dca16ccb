//! The place of a syntax error, and what stands around it.

use lipz_diagnostics::Span;

/// White space as JSON has it.
pub(in crate::parse) const WHITE_SPACE: [char; 4] = [' ', '\t', '\r', '\n'];

/// Characters of a word or name that are looked at: messages show no longer ones, and hostile files
/// cannot make it slow.
const WORD_LIMIT: usize = 40;

/// The place of a syntax error.
pub(in crate::parse) struct Place<'s> {
    text: &'s str,
    /// Byte offset of the character that was not expected.
    offset: usize,
    /// Where what was read before it ends: white space and comments are between them.
    before: usize,
}

impl<'s> Place<'s> {
    /// The place of the character with this byte, behind what ends `before`.
    pub(in crate::parse) fn new(text: &'s str, offset: usize, before: usize) -> Place<'s> {
        Place { text, offset: text.floor_char_boundary(offset), before }
    }

    pub(super) fn offset(&self) -> usize {
        self.offset
    }

    /// The text from the place on.
    pub(super) fn rest(&self) -> &'s str {
        self.text.get(self.offset..).unwrap_or_default()
    }

    /// The text from a byte on.
    pub(super) fn behind(&self, offset: usize) -> &'s str {
        self.text.get(offset..).unwrap_or_default()
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

    /// Where the last character that was read before the place is, and what it is.
    pub(super) fn before(&self) -> Option<(Span, char)> {
        let before = self.text.get(..self.before)?.trim_end_matches(WHITE_SPACE);
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
pub(in crate::parse) fn starts_element(text: &str) -> bool {
    text.strip_prefix('"').is_some_and(starts_inside_name)
}

/// Whether the text goes on as an element does whose opening quote is gone: `name":`.
pub(super) fn starts_inside_name(text: &str) -> bool {
    let is_name = |c: char| c.is_alphanumeric() || matches!(c, '_' | '-');
    let name: usize = text.chars().take(WORD_LIMIT).take_while(|&c| is_name(c)).map(char::len_utf8).sum();
    let rest = text.get(name..).and_then(|rest| rest.strip_prefix('"'));
    name > 0 && rest.is_some_and(|rest| rest.trim_start_matches(WHITE_SPACE).starts_with(':'))
}

/// Whether the text starts as an element does to which quotes or the colon were not important: `name =`.
pub(super) fn starts_bare_element(text: &str) -> bool {
    let is_quote = |c: char| matches!(c, '\'' | '"' | '‘' | '’' | '“' | '”' | '`');
    let is_name = |c: char| c.is_alphanumeric() || matches!(c, '_' | '-');
    let text = text.strip_prefix(is_quote).unwrap_or(text);
    let name: usize = text.chars().take(WORD_LIMIT).take_while(|&c| is_name(c)).map(char::len_utf8).sum();
    let rest = text.get(name..).unwrap_or_default();
    let rest = rest.strip_prefix(is_quote).unwrap_or(rest);
    name > 0 && rest.trim_start_matches([' ', '\t']).starts_with([':', '='])
}

/// Where the next element starts, or the closing brace on a line of its own, behind a byte of the text.
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
