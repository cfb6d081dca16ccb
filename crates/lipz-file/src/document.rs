//! The document model: the elements of a Lipz file in file order, with the positions of their characters.

use crate::literal_walk::LiteralWalk;
#[cfg(feature = "format")]
use crate::literal_walk::first_character;
use crate::text;
use lipz_diagnostics::Span;
use std::borrow::Cow;
use std::collections::HashMap;
use std::ops::Range;

/// The elements of a Lipz file, in file order, known and unknown.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Document<'s> {
    /// The elements.
    pub elements: Vec<Element<'s>>,
}

/// One element: `"name": value`.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Element<'s> {
    /// The name, escapes decoded.
    pub name: JsonString<'s>,
    /// The value.
    pub value: Value<'s>,
}

/// The value of an element, as far as the format interprets it.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Value<'s> {
    /// A string, escapes decoded.
    String(JsonString<'s>),
    /// A number as spelled: `24`, `24.0`, `2.4e1`.
    Number(RawJson<'s>),
    /// Anything else (`true`, `null`, an array, an object) as JSON text.
    Other(RawJson<'s>),
}

/// JSON text, kept as spelled.
#[derive(Clone, Debug)]
pub struct RawJson<'s> {
    /// The text.
    pub text: Cow<'s, str>,
    /// The position of the text.
    pub span: Span,
}

/// A decoded JSON string with the position of each of its characters in the file.
#[derive(Clone, Debug)]
pub struct JsonString<'s> {
    /// The decoded characters.
    pub text: Cow<'s, str>,
    /// The literal as in the file, usually with quotes; empty in a document that was not read from a file.
    literal: &'s str,
    /// The offset of the literal in the file.
    start: u32,
}

/// Values are equal if they have the same text, at any position.
impl PartialEq for RawJson<'_> {
    fn eq(&self, other: &Self) -> bool {
        self.text == other.text
    }
}
impl Eq for RawJson<'_> {}

/// Strings are equal if they have the same text, with any escapes and at any position.
impl PartialEq for JsonString<'_> {
    fn eq(&self, other: &Self) -> bool {
        self.text == other.text
    }
}
impl Eq for JsonString<'_> {}

impl<'s> Document<'s> {
    /// Returns the element with this name.
    pub fn get(&self, name: &str) -> Option<&Element<'s>> {
        self.elements.iter().find(|element| element.name.text == name)
    }

    /// Returns the text of the string element with this name.
    pub fn string(&self, name: &str) -> Option<&str> {
        match &self.get(name)?.value {
            Value::String(string) => Some(&string.text),
            _ => None,
        }
    }

    /// Returns the names of elements that are lost if `other` replaces this document: those that it lacks, or has with
    /// a different value. Elements that depend on recordings (`visemes`, `viseme_type`, `fps`) do not count, nor do
    /// strings without displayed characters.
    pub fn lost_in<'a>(&'a self, other: &'a Document<'_>) -> impl Iterator<Item = &'a str> {
        let is_work = |element: &&Element<'_>| match &element.value {
            _ if matches!(&*element.name.text, "visemes" | "viseme_type" | "fps") => false,
            Value::String(string) => !text::trim(&string.text).is_empty(),
            _ => true,
        };
        let mut others = HashMap::with_capacity(other.elements.len());
        for other in &other.elements {
            others.entry(other.name.text.as_ref()).or_insert(&other.value);
        }
        let is_lost = move |element: &&Element<'_>| {
            !others.get(element.name.text.as_ref()).is_some_and(|other| element.value.says_the_same(other))
        };
        self.elements.iter().filter(is_work).filter(is_lost).map(|element| &*element.name.text)
    }
}

/// Returns the trimmed segments of a text.
fn trimmed(text: &str) -> impl Iterator<Item = &str> {
    text::segments(text).map(|range| text::trim(text.get(range).unwrap_or_default()))
}

impl Value<'_> {
    /// Whether two values differ at most in spaces around `|`, which only align it.
    pub(crate) fn says_the_same(&self, other: &Value<'_>) -> bool {
        match (self, other) {
            (Value::String(one), Value::String(other)) => trimmed(&one.text).eq(trimmed(&other.text)),
            _ => self == other,
        }
    }

    /// Returns the position of the value, including the quotes of a string.
    pub fn span(&self) -> Span {
        match self {
            Value::String(string) => string.span(),
            Value::Number(raw) | Value::Other(raw) => raw.span,
        }
    }

    /// Returns the type of the value in the words of a writer.
    pub fn type_name(&self) -> &'static str {
        match self {
            Value::String(_) => "a string",
            Value::Number(_) => "a number",
            Value::Other(raw) => match raw.text.as_bytes().first() {
                Some(b'{') => "an object",
                Some(b'[') => "an array",
                Some(b'n') => "null",
                _ => "a boolean",
            },
        }
    }
}

impl<'s> RawJson<'s> {
    /// Returns JSON text that is not from a file.
    pub fn new(text: impl Into<Cow<'s, str>>) -> RawJson<'s> {
        RawJson { text: text.into(), span: Span::default() }
    }
}

impl<'s> From<Cow<'s, str>> for JsonString<'s> {
    /// Returns a string that is not from a file.
    fn from(text: Cow<'s, str>) -> Self {
        JsonString { text, literal: "", start: 0 }
    }
}

impl<'s> JsonString<'s> {
    /// Returns the string with this literal (quotes included), which starts at byte `start` of the file.
    pub(crate) fn from_literal(text: Cow<'s, str>, literal: &'s str, start: u32) -> JsonString<'s> {
        JsonString { text, literal, start }
    }

    /// Returns the position of the literal, including its quotes.
    pub fn span(&self) -> Span {
        Span::new(self.start as usize, self.start as usize + self.literal.len())
    }

    /// Returns the position of the characters of `range` (bytes of the decoded text) in the file, including escapes. An
    /// empty range leads to an empty span.
    pub fn span_of(&self, range: Range<usize>) -> Span {
        self.spans_of([range]).next().unwrap_or_default()
    }

    /// Returns the position of each range, like [`span_of`](Self::span_of). Any number of ascending ranges is found in
    /// one walk through the string.
    pub fn spans_of(&self, ranges: impl IntoIterator<Item = Range<usize>>) -> impl Iterator<Item = Span> {
        let mut walk = self.walk();
        ranges.into_iter().map(move |range| {
            let start = self.source_offset(&mut walk, range.start);
            let end = if range.is_empty() { start } else { self.source_offset(&mut walk, range.end) };
            Span::new(self.start as usize + start, self.start as usize + end)
        })
    }

    /// Returns the literal as spelled in the file, or by [`literal`](crate::literal).
    #[cfg(feature = "format")]
    pub(crate) fn spelling(&self) -> Cow<'_, str> {
        if self.literal.is_empty() { Cow::Owned(crate::literal(&self.text)) } else { Cow::Borrowed(self.literal) }
    }

    /// Returns the characters, each with its spelling in the file: `é` with `é` or `\u00e9`.
    #[cfg(feature = "format")]
    pub(crate) fn characters(&self) -> impl Iterator<Item = (char, &str)> {
        let mut rest = self.literal.get(1..).unwrap_or_default();
        self.text.char_indices().map(move |(at, character)| {
            let spelled = match first_character(rest) {
                _ if rest.is_empty() => &self.text[at..at + character.len_utf8()],
                (length, _) => rest.get(..length).unwrap_or_default(),
            };
            rest = rest.get(spelled.len()..).unwrap_or_default();
            (character, spelled)
        })
    }

    /// Returns a walk through the inner part of the literal; `None` if there are no escapes.
    fn walk(&self) -> Option<LiteralWalk<'_>> {
        let inner = self.literal.strip_prefix('"')?.get(..self.literal.len().checked_sub(2)?)?;
        (inner.len() != self.text.len()).then(|| LiteralWalk::new(inner))
    }

    /// Returns the offset in the literal of the character that starts at byte `decoded` of the text.
    fn source_offset(&self, walk: &mut Option<LiteralWalk<'_>>, decoded: usize) -> usize {
        match walk {
            Some(walk) => 1 + walk.to(decoded),
            None if !self.literal.starts_with('"') => decoded, // no quotes
            None if self.literal.len() < 2 => 0,
            None => 1 + decoded, // no escapes
        }
    }
}
