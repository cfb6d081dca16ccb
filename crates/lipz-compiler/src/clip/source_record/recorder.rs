//! The source record of a clip whose elements are added one by one, without a document.

use super::{ValueKind, is_as_spelled, push_number, push_other_text, push_spelled};
use std::ops::Range;

/// The record of a clip that contains all elements of its file, none of them joined.
pub(crate) struct Recorder<'f> {
    file: &'f str,
    segment_count: usize,
    record: Vec<u8>,
}

impl<'f> Recorder<'f> {
    /// Creates a record of this number of elements, in a buffer.
    pub(crate) fn new(file: &'f str, element_count: usize, segment_count: usize, mut record: Vec<u8>) -> Recorder<'f> {
        push_number(&mut record, element_count as u64);
        Recorder { file, segment_count, record }
    }

    /// Adds a number with this spelling, whose element has a name with this number.
    pub(crate) fn number(&mut self, name: u64, place: Range<usize>) {
        push_number(&mut self.record, name);
        push_spelled(&mut self.record, ValueKind::Number, &self.file[place]);
    }

    /// Adds a string with this spelling, of which the bank contains `held` bytes.
    pub(crate) fn string(&mut self, name: u64, place: Range<usize>, held: usize) {
        push_number(&mut self.record, name);
        if is_as_spelled(place.len(), held, self.segment_count) {
            self.record.push(ValueKind::AsInBank as u8);
        } else {
            push_other_text(&mut self.record, &self.file[place], Some(held));
        }
    }

    pub(crate) fn finish(self) -> Vec<u8> {
        self.record
    }
}
