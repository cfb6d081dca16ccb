//! The source record of a clip whose elements are told one by one, without a document.

use super::{FIRST_TEXT, Kind, NAMED, push_number, push_spelled, push_text};
use crate::clip::ClipData;

/// The record of a clip that has all elements of its file, none of them joined.
pub(crate) struct Recorder<'c> {
    clip: &'c ClipData,
    record: Vec<u8>,
}

impl<'c> Recorder<'c> {
    /// A record of so many elements, in a buffer.
    pub(crate) fn new(clip: &'c ClipData, mut record: Vec<u8>, element_count: usize) -> Recorder<'c> {
        push_number(&mut record, element_count as u64);
        Recorder { clip, record }
    }

    /// Adds a frame rate, as it is spelled.
    pub(crate) fn fps(&mut self, spelled: &str) {
        self.name("fps");
        push_spelled(&mut self.record, Kind::Number, spelled);
    }

    /// Adds an element that the bank holds as it is spelled: `viseme_type` or `visemes`.
    pub(crate) fn as_in_bank(&mut self, name: &str) {
        self.name(name);
        self.record.push(Kind::AsInBank as u8);
    }

    /// Adds the events.
    pub(crate) fn events(&mut self, string: &str) {
        self.name("events");
        push_text(&mut self.record, string, Some(self.clip.events.text().len()), self.clip.starts.len());
    }

    /// Adds the text that is in this place among those of the clip.
    pub(crate) fn text(&mut self, place: usize, string: &str) {
        push_number(&mut self.record, FIRST_TEXT + place as u64);
        let held = self.clip.texts.get(place).map(|text| self.clip.text_bytes(text));
        push_text(&mut self.record, string, held, self.clip.starts.len());
    }

    pub(crate) fn finish(self) -> Vec<u8> {
        self.record
    }

    fn name(&mut self, name: &str) {
        let index = NAMED.iter().position(|known| *known == name);
        push_number(&mut self.record, index.map_or(0, |index| 1 + index as u64));
    }
}
