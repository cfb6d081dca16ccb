//! Replacements of ranges in a section, and the new offsets of the data after them.

use super::file::NewFile;
use std::ops::Range;

/// New bytes for ranges of a section.
#[derive(Default)]
pub(super) struct Splices {
    splices: Vec<Splice>,
}

struct Splice {
    /// The replaced range, in bytes of the old section.
    old: Range<usize>,
    new: Vec<u8>,
    /// The growth of the section in bytes up to the end of this range.
    growth: isize,
}

impl Splices {
    /// Replaces a range that does not overlap any other.
    pub(super) fn add(&mut self, old: Range<usize>, new: Vec<u8>) {
        self.splices.push(Splice { old, new, growth: 0 });
    }

    /// Sorts the ranges; `None` if two of them overlap.
    pub(super) fn finish(&mut self) -> Option<()> {
        self.splices.sort_unstable_by_key(|splice| splice.old.start);
        let (mut end, mut growth) = (0, 0_isize);
        for splice in &mut self.splices {
            if splice.old.start < end {
                return None;
            }
            end = splice.old.end;
            growth += splice.new.len().cast_signed() - splice.old.len().cast_signed();
            splice.growth = growth;
        }
        Some(())
    }

    /// Returns the new offset of data at this offset of the old section; `None` if it is replaced.
    pub(super) fn moved(&self, offset: usize) -> Option<usize> {
        // Nearly everything is before or after all of them.
        let (Some(first), Some(last)) = (self.splices.first(), self.splices.last()) else { return Some(offset) };
        if offset < first.old.start {
            return Some(offset);
        }
        if offset >= last.old.end {
            return offset.checked_add_signed(last.growth);
        }
        let before = self.splices.partition_point(|splice| splice.old.end <= offset);
        let is_replaced = self.splices.get(before).is_some_and(|splice| splice.old.start <= offset);
        if is_replaced { None } else { offset.checked_add_signed(self.growth(before)) }
    }

    /// Returns the new start of the range that starts at this offset of the old section.
    pub(super) fn start(&self, offset: usize) -> Option<usize> {
        let before = self.splices.partition_point(|splice| splice.old.start < offset);
        offset.checked_add_signed(self.growth(before))
    }

    /// Returns the new length of a section with this old length.
    pub(super) fn length(&self, old_length: usize) -> Option<usize> {
        old_length.checked_add_signed(self.growth(self.splices.len()))
    }

    /// Returns the growth of the section in bytes after this number of ranges.
    fn growth(&self, count: usize) -> isize {
        count.checked_sub(1).and_then(|last| self.splices.get(last)).map_or(0, |splice| splice.growth)
    }

    /// Writes the new section to the file. The old one is in this range of the old bank.
    pub(super) fn write(&self, file: &mut NewFile<'_>, section: Range<usize>, mut place: &mut [u8]) -> Option<()> {
        let mut at = section.start;
        for splice in &self.splices {
            let (kept, rest) = place.split_at_mut_checked((section.start + splice.old.start).checked_sub(at)?)?;
            file.keep(at, kept)?;
            let (new, rest) = rest.split_at_mut_checked(splice.new.len())?;
            file.put(&splice.new, new)?;
            (at, place) = (section.start + splice.old.end, rest);
        }
        (place.len() == section.end.checked_sub(at)?).then(|| file.keep(at, place))?
    }
}
