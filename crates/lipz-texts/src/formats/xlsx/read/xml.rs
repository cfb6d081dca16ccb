//! The XML of a part: its tags and texts, in order.

use super::parts::{BoundedReader, Limits, Refusal};
use lipz_diagnostics::escape;
use quick_xml::escape::resolve_predefined_entity;
use quick_xml::events::{BytesRef, BytesStart, Event};
use quick_xml::{Reader, XmlVersion};
use std::borrow::Cow;
use std::io::BufReader;

/// The greatest depth of nested elements. Those of a cell are six deep.
const MAX_DEPTH: usize = 100;

/// A part that is being read.
pub(super) struct PartReader<'p, 'b> {
    reader: Reader<BufReader<BoundedReader<'p, 'b>>>,
    limits: &'p Limits,
    buffer: Vec<u8>,
    depth: usize,
    /// The content of the last tag, and the length of its name.
    tag: (String, usize),
    /// The last piece of text.
    text: String,
}

/// The next step in a part.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum XmlStep {
    /// A start tag. Empty elements also have an end.
    Start,
    /// The end of the innermost element.
    End,
    /// A piece of text.
    Text,
    /// Comments and other content without text.
    Other,
}

impl<'p, 'b> PartReader<'p, 'b> {
    pub(super) fn new(bytes: BoundedReader<'p, 'b>, limits: &'p Limits) -> PartReader<'p, 'b> {
        let mut reader = Reader::from_reader(BufReader::new(bytes));
        reader.config_mut().expand_empty_elements = true;
        PartReader { reader, limits, buffer: Vec::new(), depth: 0, tag: (String::new(), 0), text: String::new() }
    }

    /// Returns the next step; `None` at the end of the part.
    pub(super) fn next(&mut self) -> Result<Option<XmlStep>, Refusal> {
        self.buffer.clear();
        self.limits.begin_piece();
        let event = self.reader.read_event_into(&mut self.buffer);
        let event = event.map_err(|error| self.limits.exceeded().unwrap_or_else(|| Refusal::of(&error)))?;
        let mut text = |piece: &str| {
            self.text.clear();
            self.text.push_str(piece);
            XmlStep::Text
        };
        Ok(Some(match event {
            Event::Start(_) if self.depth == MAX_DEPTH => {
                return Err(format!("its elements are nested more than {MAX_DEPTH} deep").into());
            }
            Event::Start(tag) => {
                self.depth += 1;
                self.tag.0.clear();
                self.tag.0.push_str(&tag);
                self.tag.1 = tag.name().as_ref().len();
                XmlStep::Start
            }
            Event::End(_) => {
                self.depth -= 1;
                XmlStep::End
            }
            Event::Text(piece) => text(&piece.xml10_content()),
            Event::CData(piece) => text(&piece.xml10_content()),
            Event::GeneralRef(reference) => text(&meant(&reference)?),
            Event::DocType(_) => return Err("it has a DTD".into()),
            Event::Eof if self.depth > 0 => return Err("one of its parts ends inside an element".into()),
            Event::Eof => return Ok(None),
            Event::Comment(_) | Event::Decl(_) | Event::PI(_) | Event::Empty(_) => XmlStep::Other,
        }))
    }

    /// Returns the name of the last tag in any namespace, because there are two: strict and transitional.
    pub(super) fn name(&self) -> &str {
        let name = self.tag.0.get(..self.tag.1).unwrap_or_default();
        name.split_once(':').map_or(name, |(_, name)| name)
    }

    /// Returns an attribute of the last tag in any namespace; `None` if it is missing or invalid.
    pub(super) fn attribute(&self, name: &str) -> Option<String> {
        let tag = BytesStart::from_content(self.tag.0.as_str(), self.tag.1);
        let mut attributes = tag.attributes();
        let found = attributes.with_checks(false).flatten().find(|one| one.key.local_name().as_ref() == name)?;
        found.normalized_value(XmlVersion::Explicit1_0).ok().map(Cow::into_owned)
    }

    /// Returns all attributes of the last tag with this name, in any namespace.
    pub(super) fn attributes(&self, name: &str) -> impl Iterator<Item = String> {
        let tag = BytesStart::from_content(self.tag.0.as_str(), self.tag.1);
        let mut attributes = tag.attributes();
        let named = attributes.with_checks(false).flatten().filter(|one| one.key.local_name().as_ref() == name);
        let values = named.filter_map(|one| one.normalized_value(XmlVersion::Explicit1_0).ok().map(Cow::into_owned));
        values.collect::<Vec<_>>().into_iter()
    }

    /// Returns the last piece of text.
    pub(super) fn text(&self) -> &str {
        &self.text
    }

    /// Skips to the end of the element that has just begun.
    pub(super) fn skip(&mut self) -> Result<(), Refusal> {
        let outside = self.depth.saturating_sub(1);
        while self.depth > outside && self.next()?.is_some() {}
        Ok(())
    }

    /// Appends the text of the element that has just begun, without that of nested elements.
    pub(super) fn add_text(&mut self, out: &mut String) -> Result<(), Refusal> {
        loop {
            match self.next()? {
                Some(XmlStep::Text) => out.push_str(&self.text),
                Some(XmlStep::Start) => self.skip()?,
                Some(XmlStep::Other) => {}
                Some(XmlStep::End) | None => return Ok(()),
            }
        }
    }
}

/// Returns the text of a reference.
fn meant(reference: &BytesRef<'_>) -> Result<String, Refusal> {
    if let Some(character) = reference.resolve_char_ref().map_err(|error| Refusal::of(&error))? {
        return Ok(character.into());
    }
    let known = resolve_predefined_entity(reference).map(str::to_owned);
    known.ok_or_else(|| format!("it has an unknown XML entity: {}", escape::quoted(reference)).into())
}
