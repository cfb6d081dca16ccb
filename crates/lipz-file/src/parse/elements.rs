//! Parses text to elements: serde_json finds them, and pointers into the text determine their positions.

use super::recover::{Literal, RecoveredMembers, recover};
use super::{Fragment, syntax};
use crate::document::RawJson;
use crate::{Document, Element, JsonString, Value};
use lipz_diagnostics::{Code, Diagnostic, Span, bound, escape};
use serde_core::de::{Deserialize, Deserializer, MapAccess, Visitor};
use serde_json::value::RawValue;
use std::borrow::Cow;
use std::collections::HashMap;
use std::fmt;

/// Returns the elements of the root object, or the readable ones if there are errors.
pub(super) fn elements<'s>(text: &'s str, diagnostics: &mut Vec<Diagnostic>) -> Result<Document<'s>, Fragment<'s>> {
    let mut deserializer = serde_json::Deserializer::from_str(text);
    let members = Members::deserialize(&mut deserializer);
    let members = match members.and_then(|members| deserializer.end().map(|()| members)) {
        Ok(members) => members,
        Err(error) => return Err(fragment(text, &error, diagnostics)),
    };
    let mut elements = Vec::with_capacity(members.0.len());
    let mut complete = true;
    let literals = Literals { text, start: 0, has_escapes: has_escapes(text) };
    for member in members.0 {
        let element = literals.element(member, diagnostics);
        bound::limit_many(diagnostics);
        complete &= element.is_some();
        elements.extend(element);
    }
    complete &= unique(&mut elements, diagnostics);
    let document = Document { elements };
    if complete { Ok(document) } else { Err(Fragment { document, is_complete: false }) }
}

/// Returns the readable part of a text that is not JSON.
fn fragment<'s>(text: &'s str, error: &serde_json::Error, diagnostics: &mut Vec<Diagnostic>) -> Fragment<'s> {
    let before = diagnostics.len();
    let RecoveredMembers { members, mut is_complete } = recover(text, diagnostics);
    if diagnostics.len() == before {
        // Unreachable: the recovering parser rejects everything that serde_json rejects.
        diagnostics.push(Diagnostic::new(Code::JsonSyntax, format!("this is not JSON: {error}")));
    }
    let literals = Literals { text, start: 0, has_escapes: has_escapes(text) };
    let mut elements = Vec::with_capacity(members.len());
    for (name, value) in members {
        let name = match name {
            Literal::Json(literal) => literals.string(literal, diagnostics),
            Literal::Bare(text) => Some(literals.bare(text)),
        };
        let value = match value {
            Literal::Json(literal) => literals.value(literal, diagnostics),
            Literal::Bare(text) => Some(Value::String(literals.bare(text))),
        };
        bound::limit_many(diagnostics);
        is_complete &= name.is_some() && value.is_some();
        elements.extend(name.zip(value).map(|(name, value)| Element { name, value }));
    }
    is_complete &= unique(&mut elements, diagnostics);
    Fragment { document: Document { elements }, is_complete }
}

impl RawJson<'_> {
    /// Returns the members of an object in file order, including duplicates. `None` if the value is not an object, or
    /// if one of its strings is invalid, which is reported.
    pub fn members(&self, diagnostics: &mut Vec<Diagnostic>) -> Option<Vec<Element<'_>>> {
        let text: &str = &self.text;
        let members = Members::deserialize(&mut serde_json::Deserializer::from_str(text)).ok()?;
        let start = self.span.range().start;
        let literals = Literals { text, start, has_escapes: has_escapes(text) };
        members.0.into_iter().map(|member| literals.element(member, diagnostics)).collect()
    }
}

/// The members of an object: names and values as in the text.
struct Members<'s>(Vec<(&'s RawValue, &'s RawValue)>);

impl<'de> Deserialize<'de> for Members<'de> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct MembersVisitor;
        impl<'de> Visitor<'de> for MembersVisitor {
            type Value = Members<'de>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("an object")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Members<'de>, A::Error> {
                let mut members = Vec::with_capacity(16);
                while let Some(member) = map.next_entry()? {
                    members.push(member);
                }
                Ok(Members(members))
            }
        }
        deserializer.deserialize_map(MembersVisitor)
    }
}

fn has_escapes(text: &str) -> bool {
    memchr::memchr(b'\\', text.as_bytes()).is_some()
}

/// The literals of a text, whose syntax serde_json has accepted.
struct Literals<'s> {
    text: &'s str,
    /// The offset of the text in the file.
    start: usize,
    /// Whether any literal can have escapes, which few files do.
    has_escapes: bool,
}

impl<'s> Literals<'s> {
    /// Returns the offset of `literal` in the file.
    fn offset(&self, literal: &str) -> usize {
        (literal.as_ptr() as usize).wrapping_sub(self.text.as_ptr() as usize).wrapping_add(self.start)
    }

    fn element(
        &self,
        (name, value): (&'s RawValue, &'s RawValue),
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Option<Element<'s>> {
        let name = self.string(name.get(), diagnostics)?;
        Some(Element { name, value: self.value(value.get(), diagnostics)? })
    }

    fn value(&self, literal: &'s str, diagnostics: &mut Vec<Diagnostic>) -> Option<Value<'s>> {
        let start = self.offset(literal);
        let raw = || RawJson { text: Cow::Borrowed(literal), span: Span::new(start, start + literal.len()) };
        Some(match literal.as_bytes().first() {
            Some(b'"') => Value::String(self.string(literal, diagnostics)?),
            Some(b'-' | b'0'..=b'9') => Value::Number(raw()),
            _ => Value::Other(raw()),
        })
    }

    /// Returns a string without quotes, or with quotes that are not valid in JSON. It has no escapes.
    fn bare(&self, content: &'s str) -> JsonString<'s> {
        let start = Span::new(self.offset(content), 0).start;
        JsonString::from_literal(Cow::Borrowed(content), content, start)
    }

    /// Decodes the string.
    fn string(&self, literal: &'s str, diagnostics: &mut Vec<Diagnostic>) -> Option<JsonString<'s>> {
        let start = self.offset(literal);
        let inner = literal.get(1..literal.len().saturating_sub(1)).unwrap_or_default();
        let decoded = if self.has_escapes && has_escapes(inner) {
            match serde_json::from_str::<String>(literal) {
                Ok(decoded) => Cow::Owned(decoded),
                Err(_) => {
                    diagnostics.push(syntax::half_of_a_pair(literal, start));
                    return None;
                }
            }
        } else {
            Cow::Borrowed(inner)
        };
        Some(JsonString::from_literal(decoded, literal, Span::new(start, start).start))
    }
}

/// The most elements that are compared with each other directly.
const FEW_ELEMENTS: usize = 48;

/// Whether every name appears once. Reports and removes duplicates.
fn unique(elements: &mut Vec<Element<'_>>, diagnostics: &mut Vec<Diagnostic>) -> bool {
    // A typical file has a dozen elements, and comparing each pair is faster than any table.
    if elements.len() <= FEW_ELEMENTS {
        let texts = elements.iter().map(|element| &element.name.text);
        let is_first =
            |(index, name): (usize, &Cow<'_, str>)| elements[..index].iter().all(|other| other.name.text != *name);
        if texts.enumerate().all(is_first) {
            return true;
        }
    }
    let mut first: HashMap<&str, Span> = HashMap::with_capacity(elements.len());
    let mut again = Vec::new();
    for (index, element) in elements.iter().enumerate() {
        let span = element.name.span();
        if let Some(before) = first.get(element.name.text.as_ref()) {
            again.push(index);
            diagnostics.push(
                Diagnostic::at(
                    Code::DuplicateElement,
                    span,
                    format!("the element {} appears twice", escape::quoted(&element.name.text)),
                )
                .label("again here")
                .also(*before, "first here")
                .help("remove one of the two; programs disagree about which one counts"),
            );
            bound::limit_many(diagnostics);
        } else {
            first.insert(&element.name.text, span);
        }
    }
    let (mut index, mut repeated) = (0, again.iter().peekable());
    elements.retain(|_| {
        index += 1;
        repeated.next_if_eq(&&(index - 1)).is_none()
    });
    again.is_empty()
}
