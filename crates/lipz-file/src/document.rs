//! The document model: the elements of a Lipz file in file order, with the places of their characters.

use crate::spelled::Walk;
#[cfg(feature = "format")]
use crate::spelled::first_character;
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

/// The value of an element, as far as the format looks into it.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Value<'s> {
    /// A string, escapes decoded.
    String(JsonString<'s>),
    /// A number in its spelling: `24`, `24.0`, `2.4e1`.
    Number(Raw<'s>),
    /// Anything else (`true`, `null`, an array, an object) as JSON text.
    Other(Raw<'s>),
}

/// JSON text that is kept as it is spelled.
#[derive(Clone, Debug)]
pub struct Raw<'s> {
    /// The text.
    pub text: Cow<'s, str>,
    /// Where it is.
    pub span: Span,
}

/// A decoded JSON string that knows where each of its characters is in the file.
#[derive(Clone, Debug)]
pub struct JsonString<'s> {
    /// The decoded characters.
    pub text: Cow<'s, str>,
    /// The literal with its quotes, if the file has them; empty in a document that was not read from a file.
    literal: &'s str,
    /// Where the literal starts in the file.
    start: u32,
}

/// Values are equal when they say the same, wherever they are.
impl PartialEq for Raw<'_> {
    fn eq(&self, other: &Self) -> bool {
        self.text == other.text
    }
}
impl Eq for Raw<'_> {}

/// Strings are equal when they say the same, however they are escaped and wherever they are.
impl PartialEq for JsonString<'_> {
    fn eq(&self, other: &Self) -> bool {
        self.text == other.text
    }
}
impl Eq for JsonString<'_> {}

impl<'s> Document<'s> {
    /// The element with this name.
    pub fn get(&self, name: &str) -> Option<&Element<'s>> {
        self.elements.iter().find(|element| element.name.text == name)
    }

    /// The text of the string element with this name.
    pub fn string(&self, name: &str) -> Option<&str> {
        match &self.get(name)?.value {
            Value::String(string) => Some(&string.text),
            _ => None,
        }
    }

    /// The names of elements that are lost if `other` takes the place of this document: those that it does not have,
    /// or has with another value. What recordings decide (`visemes`, `viseme_type`, `fps`) does not count, nor do
    /// strings without characters to display.
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
            !others.get(element.name.text.as_ref()).is_some_and(|other| says_the_same(&element.value, other))
        };
        self.elements.iter().filter(is_work).filter(is_lost).map(|element| &*element.name.text)
    }
}

/// Whether two values differ at most in blanks around `|`, which only bring it below others.
fn says_the_same(one: &Value<'_>, other: &Value<'_>) -> bool {
    match (one, other) {
        (Value::String(one), Value::String(other)) => trimmed(&one.text).eq(trimmed(&other.text)),
        _ => one == other,
    }
}

/// The segments of a text without the blanks at their ends.
fn trimmed(text: &str) -> impl Iterator<Item = &str> {
    text::segments(text).map(|range| text::trim(text.get(range).unwrap_or_default()))
}

impl Value<'_> {
    /// Where the value is, with the quotes of a string.
    pub fn span(&self) -> Span {
        match self {
            Value::String(string) => string.span(),
            Value::Number(raw) | Value::Other(raw) => raw.span,
        }
    }

    /// What the value is, as a writer would call it.
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

impl<'s> Raw<'s> {
    /// JSON text that is in no file.
    pub fn new(text: impl Into<Cow<'s, str>>) -> Raw<'s> {
        Raw { text: text.into(), span: Span::default() }
    }
}

impl<'s> From<Cow<'s, str>> for JsonString<'s> {
    /// A string that is in no file.
    fn from(text: Cow<'s, str>) -> Self {
        JsonString { text, literal: "", start: 0 }
    }
}

impl<'s> JsonString<'s> {
    /// The string with this literal (quotes included), which starts at byte `start` of the file.
    pub(crate) fn from_literal(text: Cow<'s, str>, literal: &'s str, start: u32) -> JsonString<'s> {
        JsonString { text, literal, start }
    }

    /// Where the literal is, with its quotes.
    pub fn span(&self) -> Span {
        Span::new(self.start as usize, self.start as usize + self.literal.len())
    }

    /// Where the characters of `range` (bytes of the decoded text) are in the file, escapes
    /// included. An empty range gives an empty span.
    pub fn span_of(&self, range: Range<usize>) -> Span {
        self.spans_of([range]).next().unwrap_or_default()
    }

    /// Where each of the ranges is, as [`span_of`](Self::span_of) says. Ranges that ascend are found in one walk through the
    /// string, however many there are.
    pub fn spans_of(&self, ranges: impl IntoIterator<Item = Range<usize>>) -> impl Iterator<Item = Span> {
        let mut walk = self.walk();
        ranges.into_iter().map(move |range| {
            let start = self.source_offset(&mut walk, range.start);
            let end = if range.is_empty() { start } else { self.source_offset(&mut walk, range.end) };
            Span::new(self.start as usize + start, self.start as usize + end)
        })
    }

    /// The literal as it is spelled in the file, or as [`literal`](crate::literal) spells it.
    #[cfg(feature = "format")]
    pub(crate) fn spelling(&self) -> Cow<'_, str> {
        if self.literal.is_empty() { Cow::Owned(crate::literal(&self.text)) } else { Cow::Borrowed(self.literal) }
    }

    /// The characters, each with its spelling in the file: `é` with `é` or `\u00e9`.
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

    /// A walk through the inner part of the literal; `None` where escapes need no walk.
    fn walk(&self) -> Option<Walk<'_>> {
        let inner = self.literal.strip_prefix('"')?.get(..self.literal.len().checked_sub(2)?)?;
        (inner.len() != self.text.len()).then(|| Walk::new(inner))
    }

    /// Offset in the literal of the character that starts at byte `decoded` of the text.
    fn source_offset(&self, walk: &mut Option<Walk<'_>>, decoded: usize) -> usize {
        match walk {
            Some(walk) => 1 + walk.to(decoded),
            None if !self.literal.starts_with('"') => decoded, // one without quotes
            None if self.literal.len() < 2 => 0,
            None => 1 + decoded, // no escapes
        }
    }
}
