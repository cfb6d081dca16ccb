//! Stretches of a section that become others, and where everything behind them comes to stand.

use super::file::NewFile;
use std::ops::Range;

/// New bytes for stretches of a section.
#[derive(Default)]
pub(super) struct Splices {
    splices: Vec<Splice>,
}

struct Splice {
    /// What is replaced, in bytes of the old section.
    old: Range<usize>,
    new: Vec<u8>,
    /// How many bytes longer the section is up to the end of this stretch.
    growth: isize,
}

impl Splices {
    /// Replaces a stretch that no other one touches.
    pub(super) fn add(&mut self, old: Range<usize>, new: Vec<u8>) {
        self.splices.push(Splice { old, new, growth: 0 });
    }

    /// Puts the stretches into their order; `None` if two of them overlap.
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

    /// Where what stood at this offset of the old section stands in the new one; `None` if that is replaced.
    pub(super) fn moved(&self, offset: usize) -> Option<usize> {
        // Nearly everything is before or behind them all.
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

    /// Where the stretch that starts at this offset of the old section starts in the new one.
    pub(super) fn start(&self, offset: usize) -> Option<usize> {
        let before = self.splices.partition_point(|splice| splice.old.start < offset);
        offset.checked_add_signed(self.growth(before))
    }

    /// The length of a section that had this one.
    pub(super) fn length(&self, old_length: usize) -> Option<usize> {
        old_length.checked_add_signed(self.growth(self.splices.len()))
    }

    /// How many bytes longer the section is behind so many stretches.
    fn growth(&self, count: usize) -> isize {
        count.checked_sub(1).and_then(|last| self.splices.get(last)).map_or(0, |splice| splice.growth)
    }

    /// Writes the new section to the file, whose old one is in this range of the old bank.
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
