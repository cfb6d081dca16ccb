//! The curves of a clip.

use super::Curve;
use super::table::CurveTable;
use crate::{Bank, Clip, EventName};
use core::iter::FusedIterator;
use core::ops::Range;
use lipz_layout::CURVE_WIDE;
use lipz_types::StoredFps;

impl<'a> Clip<'a> {
    /// Returns the curve with this name: `jawOpen`, `anger`.
    ///
    /// A game that reads the same curves in each rendered frame looks the names up once, with
    /// [`event_name`](crate::Dialogue::event_name): `clip.curve(jaw)`.
    pub fn curve(&self, name: impl CurveName) -> Option<Curve<'a>> {
        self.numbered_curve(name.number_in(self.bank)?)
    }

    /// Returns the curve whose name has this number in the bank.
    fn numbered_curve(&self, name: u32) -> Option<Curve<'a>> {
        let curves = self.all_curves();
        let records = curves.table.curves.get(curves.range.clone())?;
        let at = records.partition_point(|record| record.name_and_width.get() & !CURVE_WIDE < name);
        curves.at(curves.range.start.wrapping_add(at)).filter(|curve| curve.name.id() == name)
    }

    /// Returns the curve at this [place](Curve::place) of the bank, without a search. The place may belong to a
    /// different clip. For programs that store places, not curves.
    pub fn curve_in_place(&self, place: u32) -> Option<Curve<'a>> {
        let table = CurveTable::new(self.bank);
        let range = 0..table.curves.len();
        Curves { table, range, bank: self.bank, fps: self.stored_fps() }.at(place as usize)
    }

    /// Returns all curves of the clip, ordered by name.
    pub fn curves(&self) -> impl Iterator<Item = Curve<'a>> + Clone {
        self.all_curves()
    }

    fn all_curves(&self) -> Curves<'a> {
        let table = CurveTable::new(self.bank);
        let place = table.clips.partition_point(|record| record.slot.get() < self.slot());
        let is_found = table.clips.get(place).map_or(false, |record| record.slot.get() == self.slot());
        let range = if is_found { table.curves_of(place) } else { None };
        // In a damaged bank, the range may end after the table.
        let range = range.map_or(0..0, |range| range.start..range.end.min(table.curves.len()));
        Curves { table, range, bank: self.bank, fps: self.stored_fps() }
    }
}

/// The name of a curve: a string, or an [`EventName`] from an earlier look-up.
pub trait CurveName: sealed::Sealed {
    /// Returns the number of the name in a bank.
    #[doc(hidden)]
    fn number_in(self, bank: &Bank<'_>) -> Option<u32>;
}

mod sealed {
    pub trait Sealed {}
    impl Sealed for &str {}
    impl Sealed for crate::EventName<'_> {}
}

impl CurveName for &str {
    fn number_in(self, bank: &Bank<'_>) -> Option<u32> {
        bank.event_name_id(self.as_bytes())
    }
}

impl CurveName for EventName<'_> {
    #[inline]
    fn number_in(self, bank: &Bank<'_>) -> Option<u32> {
        if self.key().bank == bank.origin { Some(self.id()) } else { bank.event_name_id(self.bytes()) }
    }
}

/// The curves of a clip, ordered by name.
#[derive(Clone)]
struct Curves<'a> {
    table: CurveTable<'a>,
    range: Range<usize>,
    bank: &'a Bank<'a>,
    fps: Option<StoredFps>,
}

impl<'a> Curves<'a> {
    /// Returns the curve with this index among those of all clips, unless it is damaged.
    fn at(&self, index: usize) -> Option<Curve<'a>> {
        if index >= self.range.end {
            return None;
        }
        let name = self.table.curves.get(index)?.name_and_width.get() & !CURVE_WIDE;
        let keys = self.table.keys_of(index)?;
        let name = EventName::numbered(self.bank, name)?;
        Some(Curve { name, keys, fps: self.fps, place: index as u32 })
    }
}

impl<'a> Iterator for Curves<'a> {
    type Item = Curve<'a>;

    fn next(&mut self) -> Option<Curve<'a>> {
        let curve = self.at(self.range.start);
        // A damaged curve ends the iteration.
        self.range.start = if curve.is_some() { self.range.start.wrapping_add(1) } else { self.range.end };
        curve
    }

    // Skips the curves before it unread. In a damaged bank, it may return a curve that `next` does not reach.
    fn nth(&mut self, count: usize) -> Option<Curve<'a>> {
        self.range.start = self.range.start.saturating_add(count).min(self.range.end);
        self.next()
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        let records = self.table.curves.get(self.range.clone());
        (0, Some(records.map_or(0, <[_]>::len)))
    }
}

impl FusedIterator for Curves<'_> {}
