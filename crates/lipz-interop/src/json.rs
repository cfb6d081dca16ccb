//! JSON values with their positions, for formats based on JSON.
//!
//! serde_json checks the syntax and finds the ends of values. Positions come from the addresses of its slices.

use crate::source::Line;
use lipz_diagnostics::{Code, Diagnostic, Span};
use serde::de::{Deserializer, MapAccess, SeqAccess, Visitor};
use serde_json::value::RawValue;
use std::fmt;

/// A value: its JSON text and position.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Node<'s> {
    pub(crate) line: Line<'s>,
}

/// Returns the root of a JSON text, or reports a syntax error.
pub(crate) fn root<'s>(text: &'s str, diagnostics: &mut Vec<Diagnostic>) -> Option<Node<'s>> {
    match serde_json::from_str::<&RawValue>(text) {
        Ok(raw) => Some(Node::new(raw, text, 0)),
        Err(error) => {
            diagnostics.push(syntax(text, 0, &error));
            None
        }
    }
}

/// Returns the consecutive values in a text, with or without commas between them. At a syntax error, it reports the
/// error and returns the values before.
pub(crate) fn joined<'s>(text: &'s str, diagnostics: &mut Vec<Diagnostic>) -> Vec<Node<'s>> {
    let mut nodes = Vec::new();
    let mut at = 0;
    loop {
        let rest = text.get(at..).unwrap_or_default();
        let skipped = rest.len() - rest.trim_start_matches(|c: char| c == ',' || c.is_whitespace()).len();
        at += skipped;
        let rest = text.get(at..).unwrap_or_default();
        let mut values = serde_json::Deserializer::from_str(rest).into_iter::<&RawValue>();
        match values.next() {
            None => return nodes,
            Some(Ok(raw)) => {
                nodes.push(Node::new(raw, rest, at));
                at += values.byte_offset();
            }
            Some(Err(error)) => {
                diagnostics.push(syntax(text, at, &error));
                return nodes;
            }
        }
    }
}

/// Returns the diagnostic for a syntax error after byte `at`.
fn syntax(text: &str, at: usize, error: &serde_json::Error) -> Diagnostic {
    if error.is_eof() {
        return crate::source::cut_off(text, "its JSON is not complete");
    }
    let rest = text.get(at..).unwrap_or_default();
    let before: usize = rest.split_inclusive('\n').take(error.line().saturating_sub(1)).map(str::len).sum();
    // serde_json counts columns in bytes, from 1.
    let place = text.floor_char_boundary(at + before + error.column().saturating_sub(1));
    let length = text.get(place..).and_then(|rest| rest.chars().next()).map_or(0, char::len_utf8);
    let message = error.to_string();
    let what = message.split(" at line ").next().unwrap_or(&message).to_owned();
    Diagnostic::at(Code::ForeignSyntax, Span::new(place, place + length), format!("the file is not JSON: {what}"))
}

impl<'s> Node<'s> {
    fn new(raw: &'s RawValue, text: &'s str, text_at: usize) -> Node<'s> {
        let offset = (raw.get().as_ptr() as usize).wrapping_sub(text.as_ptr() as usize);
        Node { line: Line { text: raw.get(), at: text_at + offset } }
    }

    fn child(self, raw: &'s RawValue) -> Node<'s> {
        Node::new(raw, self.line.text, self.line.at)
    }

    pub(crate) fn span(self) -> Span {
        self.line.span()
    }

    /// Returns the members of an object, with decoded names; nothing if the value is not an object.
    pub(crate) fn members(self) -> Vec<(String, Node<'s>)> {
        struct Members;
        impl<'de> Visitor<'de> for Members {
            type Value = Vec<(String, &'de RawValue)>;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("an object")
            }
            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
                let mut members = Vec::new();
                while let Some(member) = map.next_entry()? {
                    members.push(member);
                }
                Ok(members)
            }
        }
        let members = serde_json::Deserializer::from_str(self.line.text).deserialize_map(Members);
        members.unwrap_or_default().into_iter().map(|(name, raw)| (name, self.child(raw))).collect()
    }

    /// Returns the member with one of these names, in either case.
    pub(crate) fn get(self, names: &[&str]) -> Option<Node<'s>> {
        let is_one = |name: &str| names.iter().any(|known| known.eq_ignore_ascii_case(name));
        self.members().into_iter().find(|(name, _)| is_one(name)).map(|(_, node)| node)
    }

    /// Returns the items of an array; `None` if the value is not an array.
    pub(crate) fn items(self) -> Option<Vec<Node<'s>>> {
        struct Items;
        impl<'de> Visitor<'de> for Items {
            type Value = Vec<&'de RawValue>;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("an array")
            }
            fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Self::Value, A::Error> {
                let mut items = Vec::new();
                while let Some(item) = seq.next_element()? {
                    items.push(item);
                }
                Ok(items)
            }
        }
        let items = serde_json::Deserializer::from_str(self.line.text).deserialize_seq(Items).ok()?;
        Some(items.into_iter().map(|raw| self.child(raw)).collect())
    }

    /// Returns the text of a string; `None` if the value is not a string.
    pub(crate) fn string(self) -> Option<String> {
        serde_json::from_str(self.line.text).ok()
    }

    /// Returns the digits of a number, which may be in quotes; `None` for other values.
    pub(crate) fn number(self) -> Option<String> {
        match self.line.text.as_bytes().first()? {
            b'"' => self.string().map(|text| text.trim().to_owned()),
            b'-' | b'0'..=b'9' => Some(self.line.text.to_owned()),
            _ => None,
        }
    }

    pub(crate) fn is_object(self) -> bool {
        self.line.text.starts_with('{')
    }

    pub(crate) fn is_array(self) -> bool {
        self.line.text.starts_with('[')
    }

    /// Returns the diagnostic for a missing or wrong member.
    pub(crate) fn lacks(self, what: &str) -> Diagnostic {
        let start = self.line.at;
        Diagnostic::at(Code::ForeignSyntax, Span::new(start, start + 1), format!("{what} is missing here"))
    }

    /// Returns the diagnostic for a value that the format does not allow here.
    pub(crate) fn not(self, what: &str) -> Diagnostic {
        self.line.not(what)
    }
}
