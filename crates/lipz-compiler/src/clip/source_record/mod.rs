//! Source records: the differences between a Lipz file and its display form, which unpacking restores.
//!
//! A record lists the elements in file order. It does not repeat values that the bank contains: a file without padding,
//! meta and unknown elements costs a few bytes, and equal records are stored once. `docs/reference/bank-format.md`,
//! "Source records", describes the encoding.

mod recorder;

pub(crate) use recorder::Recorder;

use crate::clip::{ClipData, ClipText, Locales};
use crate::project::Options;
use foldhash::HashMap;
use lipz_file::locale::is_variant;
use lipz_file::text::{display, segments};
use lipz_file::{Document, Element, Value, curve, phones};
use std::collections::HashSet;

/// Names of elements that a record stores by number. Higher numbers are the clip's own texts.
const NAMED: [&str; 4] = ["fps", "viseme_type", "visemes", "events"];
/// Their numbers.
pub(crate) const FPS: u64 = 1;
pub(crate) const VISEME_TYPE: u64 = 2;
pub(crate) const VISEMES: u64 = 3;
pub(crate) const EVENTS: u64 = 4;
/// The number of the first of the clip's own texts.
pub(crate) const FIRST_TEXT: u64 = 1 + NAMED.len() as u64;

/// The most blanks at one side of a segment that a record stores as a count instead of spelling them out. This limits
/// the bytes of a file that one byte of a bank can produce.
const MAX_BLANKS: usize = 255;

/// The encoding of a value in a record.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum ValueKind {
    /// The bank contains the same string, with segments joined by `|`, or the same curves or phones in their canonical
    /// layout.
    AsInBank = 0,
    /// Spelled out.
    String = 1,
    Number = 2,
    Other = 3,
    /// As in the bank, with blanks around the segments: their numbers before and after each.
    Padded = 4,
}

/// The name of an element of a decoded record.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum ElementName<'r> {
    /// Spelled out.
    Spelled(&'r str),
    /// One of the format's elements, or the text in the clip's own locale with this number.
    Known(&'static str),
    OwnText(usize),
}

/// The value of an element of a decoded record.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum RecordedValue<'r> {
    /// The segments in the bank, joined with `|`.
    AsInBank,
    /// The same, with these numbers of blanks before and after each segment.
    Padded(Vec<(usize, usize)>),
    String(&'r str),
    Number(&'r str),
    Other(&'r str),
}

/// Sets the record of `clip` to that of `document`, which was checked before. Texts that are not packed are left out.
pub(crate) fn encode(document: &Document<'_>, options: &Options, locales: &Locales, clip: &mut ClipData) {
    let mut record = std::mem::take(&mut clip.source);
    let is_packed = |element: &&Element<'_>| options.packs(&element.name.text);
    push_number(&mut record, document.elements.iter().filter(is_packed).count() as u64);
    let own_texts = OwnTexts::new(&clip.texts);
    for element in document.elements.iter().filter(is_packed) {
        let name = element.name.text.as_ref();
        let locale = name.strip_prefix("text_").and_then(|tag| locales.get(tag));
        let own_text = locale.and_then(|locale| own_texts.get(locale));
        match (NAMED.iter().position(|known| *known == name), own_text) {
            (Some(index), _) => push_number(&mut record, 1 + index as u64),
            (None, Some((index, _))) => push_number(&mut record, FIRST_TEXT + index as u64),
            (None, None) => {
                push_number(&mut record, 0);
                push_string(&mut record, name);
            }
        }
        let held = held_bytes(name, own_text.map(|(_, text)| text), clip);
        match &element.value {
            Value::String(string) if is_written_so(name, &string.text, clip) => record.push(ValueKind::AsInBank as u8),
            Value::String(string) if is_joined(name, &string.text, clip) || is_filled(name, &string.text) => {
                push_spelled(&mut record, ValueKind::String, &string.text);
            }
            Value::String(string) => push_text(&mut record, &string.text, held, clip.starts.len()),
            Value::Number(raw) => push_spelled(&mut record, ValueKind::Number, &raw.text),
            Value::Other(raw) if is_written_so(name, &raw.text, clip) => record.push(ValueKind::AsInBank as u8),
            Value::Other(raw) => push_spelled(&mut record, ValueKind::Other, &raw.text),
        }
    }
    clip.source = record;
}

/// The most texts that are searched one by one, because a table would cost more.
const FEW_TEXTS: usize = 32;

/// The texts of a clip that belong to no other locale, by number.
struct OwnTexts<'c> {
    texts: &'c [ClipText],
    /// Number and index of the text of each locale, if there are many. Returns each text with its number and its index
    /// among all texts.
    places: HashMap<u32, (usize, usize)>,
}

impl<'c> OwnTexts<'c> {
    fn new(texts: &'c [ClipText]) -> OwnTexts<'c> {
        let places = match texts.len() {
            ..FEW_TEXTS => HashMap::default(),
            _ => OwnTexts::numbered(texts).map(|(number, (place, text))| (text.locale, (number, place))).collect(),
        };
        OwnTexts { texts, places }
    }

    /// Returns each text with its number and its index among all texts.
    fn numbered(texts: &[ClipText]) -> impl Iterator<Item = (usize, (usize, &ClipText))> {
        texts.iter().enumerate().filter(|(_, text)| !text.is_fallback()).enumerate()
    }

    /// Returns the text in a locale with its number.
    fn get(&self, locale: u32) -> Option<(usize, &'c ClipText)> {
        if self.texts.len() < FEW_TEXTS {
            let (number, (_, text)) = OwnTexts::numbered(self.texts).find(|(_, (_, text))| text.locale == locale)?;
            return Some((number, text));
        }
        let &(number, place) = self.places.get(&locale)?;
        Some((number, self.texts.get(place)?))
    }
}

/// Whether the bank contains the element joined into one segment, because its number of segments differs from that of
/// the clip.
fn is_joined(name: &str, text: &str, clip: &ClipData) -> bool {
    clip.has_joined && name != "viseme_type" && lipz_file::text::segment_count(text) != clip.starts.len()
}

/// Whether the bank contains a variant of a text whose blank segments are those of the text.
fn is_filled(name: &str, text: &str) -> bool {
    is_variant(name) && segments(text).any(|range| display(&text[range]).text.is_empty())
}

/// Whether the bank contains the curves or phones of an element in their exact spelling.
fn is_written_so(name: &str, text: &str, clip: &ClipData) -> bool {
    let curves = || clip.curves.iter().map(|(name, keys)| (name, keys.iter().copied()));
    match name {
        curve::ELEMENT => curve::write(curves()) == text,
        phones::ELEMENT => clip.phones.text().is_some_and(|written| written == text),
        _ => false,
    }
}

/// Returns the length in bytes of an element's segments in the bank; `None` if it has none.
fn held_bytes(name: &str, own_text: Option<&ClipText>, clip: &ClipData) -> Option<usize> {
    match name {
        "viseme_type" => clip.viseme_type.map(|viseme_type| viseme_type.name().len()),
        "visemes" => Some(clip.frames.len()),
        "events" => clip.has_events.then(|| clip.events.text().len()),
        _ => own_text.map(|text| clip.text_bytes(text)),
    }
}

/// Appends a string in the shortest encoding.
fn push_text(record: &mut Vec<u8>, text: &str, held: Option<usize>, segment_count: usize) {
    if held.is_some_and(|held| is_as_spelled(text.len(), held, segment_count)) {
        record.push(ValueKind::AsInBank as u8);
    } else {
        push_other_text(record, text, held);
    }
}

/// Whether the bank contains a string of this length completely, except for its delimiters. Its content comes from the
/// string by leaving characters out, so that equal lengths mean equal strings.
fn is_as_spelled(length: usize, held: usize, segment_count: usize) -> bool {
    held == length || held + segment_count - 1 == length
}

/// Appends a string that the bank contains with different blanks or not at all.
fn push_other_text(record: &mut Vec<u8>, text: &str, held: Option<usize>) {
    let blank = ' ';
    let segments = || segments(text).map(|range| &text[range]);
    let sides = |segment: &str| {
        let behind = segment.trim_start_matches(blank);
        (segment.len() - behind.len(), behind.len() - behind.trim_end_matches(blank).len())
    };
    let unpadded: usize = segments().map(|segment| segment.trim_matches(blank).len()).sum();
    let is_long = |(before, after)| before > MAX_BLANKS || after > MAX_BLANKS;
    if held != Some(unpadded) || segments().map(sides).any(is_long) {
        push_spelled(record, ValueKind::String, text);
        return;
    }
    record.push(ValueKind::Padded as u8);
    for (before, after) in segments().map(sides) {
        push_number(record, before as u64);
        push_number(record, after as u64);
    }
}

fn push_spelled(record: &mut Vec<u8>, kind: ValueKind, text: &str) {
    record.push(kind as u8);
    push_string(record, text);
}

fn push_number(record: &mut Vec<u8>, mut number: u64) {
    while number >= 0x80 {
        record.push(number as u8 | 0x80);
        number >>= 7;
    }
    record.push(number as u8);
}

fn push_string(record: &mut Vec<u8>, text: &str) {
    push_number(record, text.len() as u64);
    record.extend_from_slice(text.as_bytes());
}

/// Returns the elements of the record that starts at `bytes`, of a clip with this number of segments; `None` if it is
/// damaged.
pub(crate) fn decode(bytes: &[u8], segment_count: u32) -> Option<Vec<(ElementName<'_>, RecordedValue<'_>)>> {
    let mut reader = Reader { rest: bytes };
    let count = reader.number()?;
    let mut elements: Vec<(ElementName<'_>, RecordedValue<'_>)> = Vec::new();
    let mut named = HashSet::new();
    for _ in 0..count {
        let number = reader.number()?;
        // An element in the bank may occur only once. Otherwise, a few bytes could expand to much memory.
        if number > 0 && !named.insert(number) {
            return None;
        }
        let name = match number {
            0 => ElementName::Spelled(reader.string()?),
            number if number < FIRST_TEXT => ElementName::Known(NAMED.get(usize::try_from(number - 1).ok()?)?),
            number => ElementName::OwnText(usize::try_from(number - FIRST_TEXT).ok()?),
        };
        let value = match reader.byte()? {
            kind if kind == ValueKind::AsInBank as u8 => RecordedValue::AsInBank,
            kind if kind == ValueKind::Padded as u8 => RecordedValue::Padded(reader.padding(segment_count)?),
            kind if kind == ValueKind::String as u8 => RecordedValue::String(reader.string()?),
            kind if kind == ValueKind::Number as u8 => RecordedValue::Number(reader.string()?),
            kind if kind == ValueKind::Other as u8 => RecordedValue::Other(reader.string()?),
            _ => return None,
        };
        elements.push((name, value));
    }
    Some(elements)
}

struct Reader<'r> {
    rest: &'r [u8],
}

impl<'r> Reader<'r> {
    fn byte(&mut self) -> Option<u8> {
        let (&byte, rest) = self.rest.split_first()?;
        self.rest = rest;
        Some(byte)
    }

    fn number(&mut self) -> Option<u64> {
        let mut number = 0;
        for shift in (0..63).step_by(7) {
            let byte = self.byte()?;
            number |= u64::from(byte & 0x7F) << shift;
            if byte < 0x80 {
                return Some(number);
            }
        }
        None
    }

    /// Reads the numbers of blanks before and after each segment.
    fn padding(&mut self, segment_count: u32) -> Option<Vec<(usize, usize)>> {
        let mut blanks = || {
            let count = usize::try_from(self.number()?).ok()?;
            (count <= MAX_BLANKS).then_some(count)
        };
        (0..segment_count).map(|_| Some((blanks()?, blanks()?))).collect()
    }

    fn string(&mut self) -> Option<&'r str> {
        let length = usize::try_from(self.number()?).ok()?;
        let (string, rest) = self.rest.split_at_checked(length)?;
        self.rest = rest;
        std::str::from_utf8(string).ok()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn damage_is_no_panic() {
        let document = lipz_file::parse(
            br#"{"visemes":"A|-","text_en-us":" {x} Hi | ","fps":24.0,"q":[1],"text_de-de":" Na  |"}"#,
        )
        .document
        .unwrap();
        let (mut clip, mut locales) = (ClipData::default(), Locales::default());
        let options = Options::default();
        crate::check::check(
            &document,
            &options,
            crate::check::ClipSpeech::default(),
            &mut locales,
            &mut clip,
            &mut Vec::new(),
        );
        encode(&document, &options, &locales, &mut clip);
        let record = clip.source;
        let elements = decode(&record, 2).unwrap();
        assert_eq!(elements[0], (ElementName::Known("visemes"), RecordedValue::AsInBank));
        assert_eq!(elements[1], (ElementName::OwnText(1), RecordedValue::String(" {x} Hi | ")));
        assert_eq!(elements[2], (ElementName::Known("fps"), RecordedValue::Number("24.0")));
        assert_eq!(elements[3], (ElementName::Spelled("q"), RecordedValue::Other("[1]")));
        assert_eq!(elements[4], (ElementName::OwnText(0), RecordedValue::Padded(vec![(1, 2), (0, 0)])));
        for length in 0..record.len() {
            assert!(decode(&record[..length], 2).is_none(), "{length}");
        }
        for at in 0..record.len() {
            for change in 1..=255 {
                let mut damaged = record.clone();
                damaged[at] ^= change;
                let _ = decode(&damaged, 2);
            }
        }
    }

    #[test]
    fn a_few_bytes_do_not_ask_for_much_memory() {
        // A text that claims 255 blanks, one more, and 200 million; and the same text twice.
        let padded = |blanks: &[u8]| decode(&[&[1, 5, ValueKind::Padded as u8], blanks, &[0]].concat(), 1).is_some();
        assert_eq!([&[0xFF, 1][..], &[0x80, 2], &[0x80, 0x84, 0xAF, 0x5F]].map(padded), [true, false, false]);
        assert!(decode(&[2, 5, ValueKind::AsInBank as u8, 5, ValueKind::AsInBank as u8], 1).is_none());
    }
}
