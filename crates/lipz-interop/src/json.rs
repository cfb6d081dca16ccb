//! JSON that knows where each of its values stands, for formats made of it.
//!
//! serde_json checks the syntax and finds the ends of values; places come from where its slices point.

use crate::source::Line;
use lipz_diagnostics::{Code, Diagnostic, Span};
use serde::de::{Deserializer, MapAccess, SeqAccess, Visitor};
use serde_json::value::RawValue;
use std::fmt;

/// A value: its JSON text and its place.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Node<'s> {
    pub(crate) line: Line<'s>,
}

/// The root of a JSON text; reports why it is none.
pub(crate) fn root<'s>(text: &'s str, diagnostics: &mut Vec<Diagnostic>) -> Option<Node<'s>> {
    match serde_json::from_str::<&RawValue>(text) {
        Ok(raw) => Some(Node::new(raw, text, 0)),
        Err(error) => {
            diagnostics.push(syntax(text, 0, &error));
            None
        }
    }
}

/// The values that follow each other in a text, whatever commas are between them; reports where it
/// is not JSON, and gives those before.
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

/// The diagnostic for a text that is not JSON behind byte `at`.
fn syntax(text: &str, at: usize, error: &serde_json::Error) -> Diagnostic {
    if error.is_eof() {
        return crate::source::cut_off(text, "its JSON is not complete");
    }
    let rest = text.get(at..).unwrap_or_default();
    let before: usize = rest.split_inclusive('\n').take(error.line().saturating_sub(1)).map(str::len).sum();
    // serde_json counts the columns in bytes, from 1.
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

    /// The members of an object, names decoded; none if it is not an object.
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

    /// The member that has one of these names, whatever the case of their letters.
    pub(crate) fn get(self, names: &[&str]) -> Option<Node<'s>> {
        let is_one = |name: &str| names.iter().any(|known| known.eq_ignore_ascii_case(name));
        self.members().into_iter().find(|(name, _)| is_one(name)).map(|(_, node)| node)
    }

    /// The items of an array; `None` if it is none.
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

    /// The text of a string; `None` if it is none.
    pub(crate) fn string(self) -> Option<String> {
        serde_json::from_str(self.line.text).ok()
    }

    /// The digits of a number, also of one between quotes; `None` if it is neither.
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

    /// The diagnostic that it lacks a member, or has another one there.
    pub(crate) fn lacks(self, what: &str) -> Diagnostic {
        let start = self.line.at;
        Diagnostic::at(Code::ForeignSyntax, Span::new(start, start + 1), format!("{what} is missing here"))
    }

    /// The diagnostic that it is not what the format has there.
    pub(crate) fn not(self, what: &str) -> Diagnostic {
        self.line.not(what)
    }
}
