//! The XML of a part: its tags and texts, one after another.

use super::parts::{Bounded, Limits, Refusal};
use lipz_diagnostics::escape;
use quick_xml::escape::resolve_predefined_entity;
use quick_xml::events::{BytesRef, BytesStart, Event};
use quick_xml::{Reader, XmlVersion};
use std::borrow::Cow;
use std::io::BufReader;

/// How deep elements may stand in each other: those of a cell are six deep.
const MAX_DEPTH: usize = 100;

/// A part, as far as it is read.
pub(super) struct Part<'p, 'b> {
    reader: Reader<BufReader<Bounded<'p, 'b>>>,
    limits: &'p Limits,
    buffer: Vec<u8>,
    depth: usize,
    /// What stands between the brackets of the last tag, and how long its name is.
    tag: (String, usize),
    /// The last piece of a text.
    text: String,
}

/// What stands next in a part.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Step {
    /// A tag that begins an element. Empty elements have an end, too.
    Start,
    /// The end of the innermost element.
    End,
    /// A piece of a text.
    Text,
    /// What says nothing about texts: comments and the like.
    Other,
}

impl<'p, 'b> Part<'p, 'b> {
    pub(super) fn new(bytes: Bounded<'p, 'b>, limits: &'p Limits) -> Part<'p, 'b> {
        let mut reader = Reader::from_reader(BufReader::new(bytes));
        reader.config_mut().expand_empty_elements = true;
        Part { reader, limits, buffer: Vec::new(), depth: 0, tag: (String::new(), 0), text: String::new() }
    }

    /// The next step; `None` at the end of the part.
    pub(super) fn next(&mut self) -> Result<Option<Step>, Refusal> {
        self.buffer.clear();
        self.limits.begin_piece();
        let event = self.reader.read_event_into(&mut self.buffer);
        let event = event.map_err(|error| self.limits.exceeded().unwrap_or_else(|| Refusal::of(&error)))?;
        let mut text = |piece: &str| {
            self.text.clear();
            self.text.push_str(piece);
            Step::Text
        };
        Ok(Some(match event {
            Event::Start(_) if self.depth == MAX_DEPTH => {
                return Err(format!("its elements stand more than {MAX_DEPTH} deep in each other").into());
            }
            Event::Start(tag) => {
                self.depth += 1;
                self.tag.0.clear();
                self.tag.0.push_str(&tag);
                self.tag.1 = tag.name().as_ref().len();
                Step::Start
            }
            Event::End(_) => {
                self.depth -= 1;
                Step::End
            }
            Event::Text(piece) => text(&piece.xml10_content()),
            Event::CData(piece) => text(&piece.xml10_content()),
            Event::GeneralRef(reference) => text(&meant(&reference)?),
            Event::DocType(_) => return Err("it has a DTD".into()),
            Event::Eof if self.depth > 0 => return Err("one of its parts ends inside of an element".into()),
            Event::Eof => return Ok(None),
            Event::Comment(_) | Event::Decl(_) | Event::PI(_) | Event::Empty(_) => Step::Other,
        }))
    }

    /// The name of the last tag, whatever its namespace: there are two, strict and transitional.
    pub(super) fn name(&self) -> &str {
        let name = self.tag.0.get(..self.tag.1).unwrap_or_default();
        name.split_once(':').map_or(name, |(_, name)| name)
    }

    /// An attribute of the last tag, whatever its namespace; `None` too if it cannot be read.
    pub(super) fn attribute(&self, name: &str) -> Option<String> {
        let tag = BytesStart::from_content(self.tag.0.as_str(), self.tag.1);
        let mut attributes = tag.attributes();
        let found = attributes.with_checks(false).flatten().find(|one| one.key.local_name().as_ref() == name)?;
        found.normalized_value(XmlVersion::Explicit1_0).ok().map(Cow::into_owned)
    }

    /// Goes to the end of the element that has just begun.
    pub(super) fn skip(&mut self) -> Result<(), Refusal> {
        let outside = self.depth.saturating_sub(1);
        while self.depth > outside && self.next()?.is_some() {}
        Ok(())
    }

    /// Adds the text of the element that has just begun, up to its end, without those of elements in it.
    pub(super) fn add_text(&mut self, out: &mut String) -> Result<(), Refusal> {
        loop {
            match self.next()? {
                Some(Step::Text) => out.push_str(&self.text),
                Some(Step::Start) => self.skip()?,
                Some(Step::Other) => {}
                Some(Step::End) | None => return Ok(()),
            }
        }
    }
}

/// What a reference stands for.
fn meant(reference: &BytesRef<'_>) -> Result<String, Refusal> {
    if let Some(character) = reference.resolve_char_ref().map_err(|error| Refusal::of(&error))? {
        return Ok(character.into());
    }
    let known = resolve_predefined_entity(reference).map(str::to_owned);
    known.ok_or_else(|| format!("it has an entity that XML does not know: {}", escape::quoted(reference)).into())
}
