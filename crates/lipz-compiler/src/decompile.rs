//! From a bank back to documents: the reverse of lowering.

use crate::source_record::{self, Name, RecordedValue};
use crate::{BankWithTexts, dubs, layers};
use lipz_bank::{Bank, Clip, Curve, Fps, Locale, Segment};
use lipz_diagnostics::{Code, Report};
use lipz_file::{Document, Element, JsonString, Raw, Value, curve};
use lipz_layout::{Tag, U32};
use std::borrow::Cow;
use std::cell::Cell;
use zerocopy::FromBytes;

/// How many times as long as their bank all files may be, beside one file of the greatest length.
const MOST_TIMES: u64 = 256;

/// Bytes of a byte that JSON escapes.
const MOST_ESCAPED_BYTES: usize = 6;
/// Bytes of a key with the space before it: ten digits, a colon, a value of twelve characters.
const MOST_KEY_BYTES: usize = 24;

/// Bytes that all files of a bank may have. Clips share texts, events and records, so that a forged bank of a few
/// kilobytes could ask for terabytes.
pub(crate) fn budget_bytes(bank: &Bank<'_>) -> u64 {
    (lipz_file::MAX_FILE_BYTES as u64).saturating_add(MOST_TIMES.saturating_mul(bank.length_bytes() as u64))
}

/// The bytes that a file may still have.
struct Room {
    left: Cell<u64>,
    is_exceeded: Cell<bool>,
}

impl Room {
    fn new(bytes: u64) -> Room {
        Room { left: Cell::new(bytes), is_exceeded: Cell::new(false) }
    }

    /// Takes so many bytes; `None` if they are too many.
    fn take(&self, bytes: usize) -> Option<()> {
        match self.left.get().checked_sub(bytes as u64) {
            Some(left) => {
                self.left.set(left);
                Some(())
            }
            None => {
                self.is_exceeded.set(true);
                None
            }
        }
    }
}

/// The Lipz files of a bank, in the order of their keys.
pub struct Documents<'data, 'bank> {
    bank: &'bank Bank<'data>,
    /// The locales whose texts the files have.
    locales: Vec<Locale<'data>>,
    sources: Option<Sources<'data>>,
}

struct Sources<'data> {
    index: &'data [U32],
    records: &'data [u8],
}

impl<'data, 'bank> Documents<'data, 'bank> {
    /// The files of a verified bank. Those of a bank that was split are not exact: source records stay with texts
    /// that are in the bank itself.
    ///
    /// # Errors
    /// If one of the two source sections is missing or has another shape, and if the bank is a layer that has only the
    /// texts of a clip, or all but these.
    pub fn from_bank(bank: impl Into<BankWithTexts<'data, 'bank>>) -> Result<Self, Report> {
        let whole: BankWithTexts<'data, 'bank> = bank.into();
        let bank = whole.bank();
        if layers::has_parts(bank) {
            return Err(Report::failure(
                "",
                Code::LayerAlone,
                "the bank is a layer with only parts of some clips",
                "name the banks that it lies over, too: `base.lipzbank+layer.lipzbank`",
            ));
        }
        let section = |tag: Tag| bank.sections().find(|(found, _)| *found == tag.0).map(|(_, bytes)| bytes);
        let sources = match (section(Tag::SOURCE_INDEX), section(Tag::SOURCES)) {
            (None, None) => None,
            (Some(index), Some(records)) => {
                let index = <[U32]>::ref_from_bytes(index).ok().filter(|index| index.len() == bank.clip_count());
                let index = index.ok_or_else(|| damaged("the source index has another length"))?;
                Some(Sources { index, records })
            }
            _ => return Err(damaged("one of the two source sections is missing")),
        };
        // Source records count the locales that their bank has.
        let locales = if sources.is_some() { bank.locales().collect() } else { whole.locales() };
        Ok(Documents { bank, locales, sources })
    }

    /// Whether the bank holds what the display form lost, so that the files are exact.
    pub fn is_exact(&self) -> bool {
        self.sources.is_some()
    }

    /// Key and document of each clip. Documents that are longer than a Lipz file may be, or all together much longer
    /// than the bank (docs/FORMAT.md, "Source records"), are errors.
    pub fn iter(&self) -> impl Iterator<Item = Result<(&'data str, Document<'data>), Report>> + '_ {
        let mut left = budget_bytes(self.bank);
        self.bank.clips().map(move |clip| {
            let most = left.min(lipz_file::MAX_FILE_BYTES as u64);
            let room = Room::new(most);
            let document = self.document(&clip, &room);
            left = left.saturating_sub(most.saturating_sub(room.left.get()));
            if room.is_exceeded.get() {
                let message = format!("the bank asks for more bytes than its files may have, at `{}`", clip.key());
                return Err(damaged(&message));
            }
            Ok((clip.key(), document?))
        })
    }

    fn document(&self, clip: &Clip<'data, '_>, room: &Room) -> Result<Document<'data>, Report> {
        let original = clip.original();
        let is_own = |locale: &Locale<'data>| {
            let text = clip.segment(0).and_then(|segment| segment.text(*locale));
            text.is_some_and(|text| !text.is_fallback()) && !dubs::borrows(clip, original.as_ref(), *locale)
        };
        let own: Vec<Locale<'data>> = self.locales.iter().copied().filter(is_own).collect();
        match &self.sources {
            Some(sources) => {
                let damage = || damaged(&format!("the source record of `{}` cannot be decoded", clip.key()));
                let offset = sources.index.get(clip.slot() as usize).ok_or_else(damage)?.get();
                let record = sources.records.get(offset as usize..).ok_or_else(damage)?;
                exact(clip, &own, record, room).ok_or_else(damage)
            }
            None => Ok(display_form(clip, &own, room)),
        }
    }
}

fn damaged(what: &str) -> Report {
    Report::failure("", Code::SourceDamaged, what.to_owned(), "pack the bank again from its sources")
}

/// The document as it was written.
fn exact<'data>(
    clip: &Clip<'data, '_>,
    own: &[Locale<'data>],
    record: &'data [u8],
    room: &Room,
) -> Option<Document<'data>> {
    let mut elements = Vec::new();
    for (name, value) in source_record::decode(record, clip.segment_count())? {
        let held = |padding: &[(usize, usize)]| match name {
            Name::Known("viseme_type") => Some(clip.viseme_type()?.name().to_owned()),
            Name::Known("visemes") => joined(clip, padding, room, codes),
            Name::Known("events") => joined(clip, padding, room, Segment::event),
            Name::OwnText(index) => joined(clip, padding, room, display_text(*own.get(index)?)),
            _ => None,
        };
        let value = match value {
            RecordedValue::AsInBank if name == Name::Spelled(curve::ELEMENT) => {
                Value::Other(Raw::new(curves(clip, room)?))
            }
            RecordedValue::AsInBank => Value::String(Cow::<str>::Owned(held(&[])?).into()),
            RecordedValue::Padded(padding) => Value::String(Cow::<str>::Owned(held(&padding)?).into()),
            RecordedValue::String(spelled) | RecordedValue::Number(spelled) | RecordedValue::Other(spelled) => {
                room.take(spelled.len())?;
                match value {
                    RecordedValue::Number(_) | RecordedValue::Other(_) if !is_json(spelled) => return None,
                    RecordedValue::Number(number) => Value::Number(Raw::new(number)),
                    RecordedValue::Other(json) => Value::Other(Raw::new(json)),
                    _ => Value::String(Cow::Borrowed(spelled).into()),
                }
            }
        };
        let name = match name {
            Name::Spelled(name) => Cow::Borrowed(name),
            Name::Known(name) => Cow::Borrowed(name),
            Name::OwnText(index) => Cow::Owned(format!("text_{}", own.get(index)?.tag())),
        };
        room.take(name.len())?;
        elements.push(Element { name: name.into(), value });
    }
    Some(Document { elements })
}

/// The document in canonical order, with display texts.
fn display_form<'data>(clip: &Clip<'data, '_>, own: &[Locale<'data>], room: &Room) -> Document<'data> {
    let mut elements = Vec::new();
    let mut push = |name: String, value: Value<'data>| {
        elements.push(Element { name: JsonString::from(Cow::Owned(name)), value });
    };
    let string = |text: String| Value::String(Cow::<str>::Owned(text).into());
    if let Some(fps) = clip.fps() {
        push("fps".into(), Value::Number(Raw::new(decimal(fps))));
    }
    if let Some(viseme_type) = clip.viseme_type() {
        push("viseme_type".into(), string(viseme_type.name().into()));
    }
    if let Some(visemes) = joined(clip, &[], room, codes).filter(|_| clip.has_visemes()) {
        push("visemes".into(), string(visemes));
    }
    for locale in own {
        if let Some(text) = joined(clip, &[], room, display_text(*locale)) {
            push(format!("text_{}", locale.tag()), string(text));
        }
    }
    if let Some(events) = joined(clip, &[], room, Segment::event) {
        push("events".into(), string(events));
    }
    if let Some(curves) = curves(clip, room).filter(|_| clip.curves().next().is_some()) {
        push(curve::ELEMENT.into(), Value::Other(Raw::new(curves)));
    }
    Document { elements }
}

/// The curves of the clip as JSON; `None` where there is no room.
fn curves(clip: &Clip<'_, '_>, room: &Room) -> Option<String> {
    for curve in clip.curves() {
        let name_bytes = curve.name().as_str().len().saturating_mul(MOST_ESCAPED_BYTES);
        let keys_bytes = (curve.key_count() as usize).saturating_mul(MOST_KEY_BYTES);
        room.take(name_bytes.saturating_add(keys_bytes).saturating_add(MOST_KEY_BYTES))?;
    }
    let keys = |curve: &Curve<'_>| curve.keys().map(|key| (key.frame, key.value)).collect::<Vec<_>>();
    let curves: Vec<_> = clip.curves().map(|curve| (curve.name().as_str(), keys(&curve))).collect();
    Some(curve::write(curves))
}

fn codes<'data>(segment: &Segment<'data, '_>) -> Option<&'data str> {
    std::str::from_utf8(segment.frames()).ok()
}

fn display_text<'data>(locale: Locale<'data>) -> impl Fn(&Segment<'data, '_>) -> Option<&'data str> {
    move |segment| Some(segment.text(locale)?.as_str())
}

/// The parts of all segments with `|` between them, if every segment has one; with blanks before
/// and after each as in `padding`; `None` also where there is no room.
fn joined<'data, 'bank>(
    clip: &Clip<'data, 'bank>,
    padding: &[(usize, usize)],
    room: &Room,
    part: impl Fn(&Segment<'data, 'bank>) -> Option<&'data str>,
) -> Option<String> {
    let mut whole = String::new();
    for segment in clip.segments() {
        let (before, after) = padding.get(segment.index() as usize).copied().unwrap_or_default();
        if segment.index() > 0 {
            whole.push(lipz_file::text::DELIMITER);
        }
        let part = part(&segment)?;
        room.take(part.len().saturating_add(before).saturating_add(after).saturating_add(1))?;
        whole.extend(std::iter::repeat_n(' ', before));
        whole.push_str(part);
        whole.extend(std::iter::repeat_n(' ', after));
    }
    Some(whole)
}

/// The rate as a decimal number: exact where the ratio has an end, otherwise the nearest `f64`.
fn decimal(fps: Fps) -> String {
    fps.to_f64().to_string()
}
/// Whether a record that may be forged has one JSON value here, and no more: it is written as it is.
fn is_json(value: &str) -> bool {
    let is_whole_number =
        !value.is_empty() && !value.starts_with('0') && value.bytes().all(|byte| byte.is_ascii_digit());
    if is_whole_number {
        return true;
    }
    let file = format!("{{\"x\":{value}}}");
    let document = lipz_file::parse(file.as_bytes()).document;
    document.is_some_and(|document| match document.elements.as_slice() {
        [Element { value: Value::Number(raw) | Value::Other(raw), .. }] => raw.text == value,
        _ => false,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_one_value_is_json() {
        for value in ["24", "0", "2.5e1", "-0.50", "null", "[1, {\"a\": \"}\"}]", "{}"] {
            assert!(is_json(value), "{value}");
        }
        for value in ["", "024", "1,\"y\":2", "1}", "nul", "\"a\"", " 1", "1 ", "1\n", "{} {}", "24 /**/"] {
            assert!(!is_json(value), "{value}");
        }
    }
}
