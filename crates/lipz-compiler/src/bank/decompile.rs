//! Conversion of a dialogue back to documents: the reverse of lowering.

use crate::bank::dialogue::{DubTexts, TaggedLocale, banks, clips_by_key, length_bytes, locales_by_tag, topmost};
use crate::bank::layers;
use crate::clip::ClipPhones;
use crate::clip::source_record::{self, ElementName, RecordedValue};
use lipz_bank::curve::Curve;
use lipz_bank::{Bank, Clip, Dialogue, Fps, Locale, Segment};
use lipz_diagnostics::{Code, Report};
use lipz_file::{Document, Element, JsonString, RawJson, Value, curve, phones};
use lipz_layout::{Tag, U32};
use std::borrow::Cow;
use std::cell::Cell;
use zerocopy::FromBytes;

/// The maximum length of all files relative to their bank, in addition to one file of the maximum length.
const MOST_TIMES: u64 = 256;

/// The length in bytes of a byte that JSON escapes.
const MOST_ESCAPED_BYTES: usize = 6;
/// The length of a key with the space before it: ten digits, a colon, a value of twelve characters.
const MOST_KEY_BYTES: usize = 24;

/// Returns the number of bytes that all files of a dialogue may have. Clips share texts, events and records, so that a
/// forged bank of a few kilobytes could otherwise expand to terabytes.
pub(crate) fn budget_bytes(dialogue: &Dialogue<'_>) -> u64 {
    (lipz_file::MAX_FILE_BYTES as u64).saturating_add(MOST_TIMES.saturating_mul(length_bytes(dialogue) as u64))
}

/// The remaining bytes of a file.
struct Room {
    left: Cell<u64>,
    is_exceeded: Cell<bool>,
}

impl Room {
    fn new(bytes: u64) -> Room {
        Room { left: Cell::new(bytes), is_exceeded: Cell::new(false) }
    }

    /// Takes this many bytes; `None` if too few remain.
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

/// The Lipz files of a dialogue, sorted by key.
pub struct Documents<'d> {
    dialogue: &'d Dialogue<'d>,
    clips: Vec<Clip<'d>>,
    /// The locales of the texts in the files.
    locales: Vec<TaggedLocale<'d>>,
    /// The source records of each bank, by the number of its file; `None` if a bank has none.
    sources: Option<Vec<Option<Sources<'d>>>>,
}

struct Sources<'data> {
    index: &'data [U32],
    records: &'data [u8],
}

impl<'d> Sources<'d> {
    /// Returns the source records of a bank, if it has any.
    fn of(bank: &Bank<'d>) -> Result<Option<Sources<'d>>, Report> {
        let section = |tag: Tag| bank.sections().find(|(found, _)| *found == tag.0).map(|(_, bytes)| bytes);
        match (section(Tag::SOURCE_INDEX), section(Tag::SOURCES)) {
            (None, None) => Ok(None),
            (Some(index), Some(records)) => {
                let index = <[U32]>::ref_from_bytes(index).ok().filter(|index| index.len() == bank.clip_count());
                let index = index.ok_or_else(|| damaged("the source index has the wrong length"))?;
                Ok(Some(Sources { index, records }))
            }
            _ => Err(damaged("one of the two source sections is missing")),
        }
    }
}

impl<'d> Documents<'d> {
    /// Creates the files of a verified dialogue. They are exact if all of its banks have source records. Those of a
    /// split bank are not exact, because a bank keeps source records only with its texts.
    ///
    /// # Errors
    /// If one of the two source sections of a bank is missing or has the wrong shape, or if the dialogue is a single
    /// patch that has only the texts of a clip, or everything but these.
    pub fn from_dialogue(dialogue: &'d Dialogue<'d>) -> Result<Self, Report> {
        if dialogue.bank(0).is_some_and(layers::has_parts) {
            return Err(Report::failure(
                "",
                Code::LayerAlone,
                "the bank is a patch with only parts of some clips",
                "also name the banks below it: `base.lipzbank+patch.lipzbank`",
            ));
        }
        let mut all: Vec<Option<Sources<'d>>> = (0..dialogue.file_count()).map(|_| None).collect();
        let mut are_exact = true;
        for (number, bank) in banks(dialogue) {
            all[number] = Sources::of(bank)?;
            are_exact &= all[number].is_some();
        }
        let mut locales = locales_by_tag(dialogue);
        if are_exact {
            // Source records refer to locales by their number in the bank.
            locales.retain(|locale| banks(dialogue).any(|(_, bank)| bank.locale(locale.tag).is_some()));
        }
        Ok(Documents { dialogue, clips: clips_by_key(dialogue), locales, sources: are_exact.then_some(all) })
    }

    /// Whether the banks contain the differences from the display form, so that the files are exact.
    pub fn is_exact(&self) -> bool {
        self.sources.is_some()
    }

    /// Returns the clips of the files, sorted by key.
    pub fn clips(&self) -> &[Clip<'d>] {
        &self.clips
    }

    /// Returns key and document of each clip. Errors are documents longer than the limit of a Lipz file, and documents
    /// that together are much longer than the banks (docs/reference/bank-format.md, "Source records").
    pub fn iter(&self) -> impl Iterator<Item = Result<(&'d str, Document<'d>), Report>> + '_ {
        let mut left = budget_bytes(self.dialogue);
        self.clips.iter().map(move |clip| {
            let most = left.min(lipz_file::MAX_FILE_BYTES as u64);
            let room = Room::new(most);
            let document = self.document(clip, &room);
            left = left.saturating_sub(most.saturating_sub(room.left.get()));
            if room.is_exceeded.get() {
                let message = format!("the Lipz files of the bank exceed the size limit at `{}`", clip.key());
                return Err(damaged(&message));
            }
            Ok((clip.key(), document?))
        })
    }

    fn document(&self, clip: &Clip<'d>, room: &Room) -> Result<Document<'d>, Report> {
        let of_dub = DubTexts::of(self.dialogue, clip);
        let is_own = |locale: &&TaggedLocale<'d>| {
            clip.segment(0).is_some_and(|segment| segment.has_own_text(locale.locale))
                && !of_dub.as_ref().is_some_and(|dub| dub.are_borrowed(clip, locale))
        };
        let own: Vec<TaggedLocale<'d>> = self.locales.iter().filter(is_own).copied().collect();
        match &self.sources {
            Some(sources) => {
                let record = || {
                    let (number, found) = topmost(self.dialogue, clip)?;
                    let sources = sources.get(number)?.as_ref()?;
                    sources.records.get(sources.index.get(found.slot() as usize)?.get() as usize..)
                };
                let exact = record().and_then(|record| exact(clip, &own, record, room));
                exact.ok_or_else(|| damaged(&format!("the source record of `{}` cannot be decoded", clip.key())))
            }
            None => Ok(display_form(clip, &own, room)),
        }
    }
}

fn damaged(what: &str) -> Report {
    Report::failure("", Code::SourceDamaged, what.to_owned(), "pack the bank again from its sources")
}

/// Returns the original document.
fn exact<'data>(
    clip: &Clip<'data>,
    own: &[TaggedLocale<'_>],
    record: &'data [u8],
    room: &Room,
) -> Option<Document<'data>> {
    let mut elements = Vec::new();
    for (name, value) in source_record::decode(record, clip.segment_count())? {
        let held = |padding: &[(usize, usize)]| match name {
            ElementName::Known("viseme_type") => Some(clip.viseme_type()?.name().to_owned()),
            ElementName::Known("visemes") => joined(clip, padding, room, codes),
            ElementName::Known("events") => joined(clip, padding, room, Segment::event),
            ElementName::OwnText(index) => joined(clip, padding, room, display_text(own.get(index)?.locale)),
            _ => None,
        };
        let value = match value {
            RecordedValue::AsInBank if name == ElementName::Spelled(curve::ELEMENT) => {
                Value::Other(RawJson::new(curves(clip, room)?))
            }
            RecordedValue::AsInBank if name == ElementName::Spelled(phones::ELEMENT) => {
                Value::String(Cow::<str>::Owned(phone_track(clip, room)?).into())
            }
            RecordedValue::AsInBank => Value::String(Cow::<str>::Owned(held(&[])?).into()),
            RecordedValue::Padded(padding) => Value::String(Cow::<str>::Owned(held(&padding)?).into()),
            RecordedValue::String(spelled) | RecordedValue::Number(spelled) | RecordedValue::Other(spelled) => {
                room.take(spelled.len())?;
                match value {
                    RecordedValue::Number(_) | RecordedValue::Other(_) if !is_json(spelled) => return None,
                    RecordedValue::Number(number) => Value::Number(RawJson::new(number)),
                    RecordedValue::Other(json) => Value::Other(RawJson::new(json)),
                    _ => Value::String(Cow::Borrowed(spelled).into()),
                }
            }
        };
        let name = match name {
            ElementName::Spelled(name) => Cow::Borrowed(name),
            ElementName::Known(name) => Cow::Borrowed(name),
            ElementName::OwnText(index) => Cow::Owned(format!("text_{}", own.get(index)?.tag)),
        };
        room.take(name.len())?;
        elements.push(Element { name: name.into(), value });
    }
    Some(Document { elements })
}

/// Returns the document in canonical order, with display texts.
fn display_form<'data>(clip: &Clip<'data>, own: &[TaggedLocale<'_>], room: &Room) -> Document<'data> {
    let mut elements = Vec::new();
    let mut push = |name: String, value: Value<'data>| {
        elements.push(Element { name: JsonString::from(Cow::Owned(name)), value });
    };
    let string = |text: String| Value::String(Cow::<str>::Owned(text).into());
    if let Some(fps) = clip.fps() {
        push("fps".into(), Value::Number(RawJson::new(decimal(fps))));
    }
    if let Some(viseme_type) = clip.viseme_type() {
        push("viseme_type".into(), string(viseme_type.name().into()));
    }
    if let Some(visemes) = joined(clip, &[], room, codes).filter(|_| clip.has_visemes()) {
        push("visemes".into(), string(visemes));
    }
    for locale in own {
        if let Some(text) = joined(clip, &[], room, display_text(locale.locale)) {
            push(format!("text_{}", locale.tag), string(text));
        }
    }
    if let Some(events) = joined(clip, &[], room, Segment::event) {
        push("events".into(), string(events));
    }
    if let Some(curves) = curves(clip, room).filter(|_| clip.curves().next().is_some()) {
        push(curve::ELEMENT.into(), Value::Other(RawJson::new(curves)));
    }
    if let Some(phones) = phone_track(clip, room) {
        push(phones::ELEMENT.into(), string(phones));
    }
    Document { elements }
}

/// Returns the curves of the clip as JSON; `None` if the bytes do not suffice.
fn curves(clip: &Clip<'_>, room: &Room) -> Option<String> {
    for curve in clip.curves() {
        let name_bytes = curve.name().as_str().len().saturating_mul(MOST_ESCAPED_BYTES);
        let keys_bytes = (curve.key_count() as usize).saturating_mul(MOST_KEY_BYTES);
        room.take(name_bytes.saturating_add(keys_bytes).saturating_add(MOST_KEY_BYTES))?;
    }
    let keys = |curve: &Curve<'_>| curve.keys().map(|key| (key.frame, key.value)).collect::<Vec<_>>();
    let curves: Vec<_> = clip.curves().map(|curve| (curve.name().as_str(), keys(&curve))).collect();
    Some(curve::write(curves))
}

/// Returns the value of the element `phones`; `None` if the clip has no phones, or the bytes do not suffice.
fn phone_track(clip: &Clip<'_>, room: &Room) -> Option<String> {
    room.take((clip.phones().count() as usize).saturating_mul(MOST_KEY_BYTES))?;
    let mut phones = ClipPhones::default();
    phones.recall(clip);
    phones.text()
}

fn codes<'data>(segment: &Segment<'data>) -> Option<&'data str> {
    std::str::from_utf8(segment.frames()).ok()
}

fn display_text<'data>(locale: Locale) -> impl Fn(&Segment<'data>) -> Option<&'data str> {
    move |segment| Some(segment.text(locale)?.as_str())
}

/// Returns the parts of all segments with `|` between them, if every segment has one, with blanks before and after each
/// as in `padding`; `None` also if the bytes do not suffice.
fn joined<'data>(
    clip: &Clip<'data>,
    padding: &[(usize, usize)],
    room: &Room,
    part: impl Fn(&Segment<'data>) -> Option<&'data str>,
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

/// Returns the rate as a decimal number: exact if the ratio has a finite form, otherwise the nearest `f64`.
fn decimal(fps: Fps) -> String {
    fps.to_f64().to_string()
}
/// Whether the text is exactly one JSON value. It comes from a record that may be forged, and is written unchanged.
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
