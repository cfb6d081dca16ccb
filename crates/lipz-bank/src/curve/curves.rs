//! The curves of a clip.

use super::Curve;
use super::table::CurveTable;
use crate::event::EventNames;
use crate::{Clip, EventName};
use core::fmt;
use core::iter::FusedIterator;
use core::ops::Range;
use lipz_layout::CURVE_WIDE;
use lipz_types::StoredFps;

impl<'data> Clip<'data, '_> {
    /// The curve with this name: `jawOpen`, `anger`.
    ///
    /// A game that asks for the same ones each time looks the names up once, with [`Bank::event_name`](crate::Bank::event_name),
    /// and calls [`Clip::curve_named`].
    pub fn curve(&self, name: &str) -> Option<Curve<'data>> {
        self.curve_named(self.bank.event_name(name)?)
    }

    /// The curve with this name of the same bank.
    pub fn curve_named(&self, name: EventName<'_>) -> Option<Curve<'data>> {
        name.assert_is_of(self.bank);
        if !name.is_of(self.bank) {
            return None;
        }
        let curves = self.curves();
        let records = curves.table.curves.get(curves.range.clone())?;
        let at = records.partition_point(|record| record.name_and_width.get() & !CURVE_WIDE < name.id());
        curves.at(curves.range.start.wrapping_add(at)).filter(|curve| curve.name.id() == name.id())
    }

    /// The curve in this [place](Curve::place) of the bank, without a search: of this clip or, if the place is one of another clip,
    /// of that one. For programs that keep places and not curves.
    pub fn curve_in_place(&self, place: u32) -> Option<Curve<'data>> {
        let table = CurveTable::new(self.bank);
        let range = 0..table.curves.len();
        Curves { table, range, names: self.bank.event_names(), fps: self.stored_fps() }.at(place as usize)
    }

    /// All curves of the clip, in the order of their names.
    pub fn curves(&self) -> Curves<'data> {
        let table = CurveTable::new(self.bank);
        let place = table.clips.partition_point(|record| record.slot.get() < self.slot());
        let is_found = table.clips.get(place).map_or(false, |record| record.slot.get() == self.slot());
        let range = if is_found { table.curves_of(place) } else { None };
        // In a damaged bank it may end behind the table.
        let range = range.map_or(0..0, |range| range.start..range.end.min(table.curves.len()));
        Curves { table, range, names: self.bank.event_names(), fps: self.stored_fps() }
    }
}

/// The curves of a clip in the order of their names; see [`Clip::curves`].
#[derive(Clone)]
pub struct Curves<'data> {
    table: CurveTable<'data>,
    range: Range<usize>,
    names: EventNames<'data>,
    fps: Option<StoredFps>,
}

impl<'data> Curves<'data> {
    /// The curve with this index among those of all clips, unless it is damaged.
    fn at(&self, index: usize) -> Option<Curve<'data>> {
        if index >= self.range.end {
            return None;
        }
        let name = self.table.curves.get(index)?.name_and_width.get() & !CURVE_WIDE;
        let keys = self.table.keys_of(index)?;
        Some(Curve { name: self.names.numbered(name)?, keys, fps: self.fps, place: index as u32 })
    }
}

impl<'data> Iterator for Curves<'data> {
    type Item = Curve<'data>;

    fn next(&mut self) -> Option<Curve<'data>> {
        let curve = self.at(self.range.start);
        // A damaged curve ends the iteration.
        self.range.start = if curve.is_some() { self.range.start.wrapping_add(1) } else { self.range.end };
        curve
    }

    // Without a look at those before it: of a damaged bank, it may give one that `next` does not come to.
    fn nth(&mut self, count: usize) -> Option<Curve<'data>> {
        self.range.start = self.range.start.saturating_add(count).min(self.range.end);
        self.next()
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        let records = self.table.curves.get(self.range.clone());
        (0, Some(records.map_or(0, <[_]>::len)))
    }
}

impl FusedIterator for Curves<'_> {}

/// The curves.
impl fmt::Debug for Curves<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.clone()).finish()
    }
}
