//! The sections of curves.

use super::{CurveKey, CurveValue};
use crate::Bank;
use crate::file::entries;
use core::ops::Range;
use lipz_layout::{CURVE_WIDE, CurveClipRecord, CurveKeyRecord, CurveRecord, Tag, U32, WideCurveKeyRecord};
use zerocopy::IntoBytes;

/// The sections of curves; empty in a bank without them.
#[derive(Clone, Copy)]
pub(crate) struct CurveTable<'data> {
    pub(crate) clips: &'data [CurveClipRecord],
    pub(crate) curves: &'data [CurveRecord],
    /// Keys, in units of four bytes.
    pub(crate) units: &'data [U32],
}

impl<'data> CurveTable<'data> {
    /// Returns the curve sections of a bank.
    #[cfg_attr(not(target_pointer_width = "64"), inline(never))]
    pub(crate) fn new(bank: &Bank<'data>) -> Self {
        let clips: &[CurveClipRecord] = entries(bank.file.section(Tag::CURVE_CLIPS));
        if clips.is_empty() {
            return CurveTable { clips, curves: &[], units: &[] };
        }
        CurveTable {
            clips,
            curves: entries(bank.file.section(Tag::CURVES)),
            units: entries(bank.file.section(Tag::CURVE_KEYS)),
        }
    }

    /// Returns the indices of the curves of the clip at `place` in `clips`.
    #[cfg_attr(not(target_pointer_width = "64"), inline(never))]
    pub(crate) fn curves_of(&self, place: usize) -> Option<Range<usize>> {
        let first = self.clips.get(place)?.curves_first.get() as usize;
        let next = self.clips.get(place.wrapping_add(1));
        Some(first..next.map_or(self.curves.len(), |next| next.curves_first.get() as usize))
    }

    /// Returns where the keys of the curve with this index end, in units.
    pub(crate) fn keys_end(&self, curve: usize) -> usize {
        self.curves.get(curve.wrapping_add(1)).map_or(self.units.len(), |next| next.keys_first.get() as usize)
    }

    /// Returns the keys of the curve with this index, if they are in their section.
    #[cfg_attr(not(target_pointer_width = "64"), inline(never))]
    pub(crate) fn keys_of(&self, curve: usize) -> Option<Keys<'data>> {
        let record = self.curves.get(curve)?;
        let bytes = self.units.get(record.keys_first.get() as usize..self.keys_end(curve))?.as_bytes();
        Some(match record.name_and_width.get() & CURVE_WIDE {
            0 => Keys::Narrow(entries(bytes)),
            _ => Keys::Wide(entries(bytes)),
        })
    }
}

/// The keys of a curve.
#[derive(Clone, Copy)]
pub(crate) enum Keys<'data> {
    /// Four bytes each.
    Narrow(&'data [CurveKeyRecord]),
    /// Eight bytes each.
    Wide(&'data [WideCurveKeyRecord]),
}

impl Keys<'_> {
    pub(crate) fn count(self) -> u32 {
        match self {
            Keys::Narrow(keys) => keys.len() as u32,
            Keys::Wide(keys) => keys.len() as u32,
        }
    }

    // Not inlined where memory is scarce, because several places need it.
    #[cfg_attr(not(target_pointer_width = "64"), inline(never))]
    pub(crate) fn get(self, index: u32) -> Option<CurveKey> {
        let (frame, thousandths) = match self {
            Keys::Narrow(keys) => {
                let key = keys.get(index as usize)?;
                (u32::from(key.frame.get()), i32::from(key.thousandths.get()))
            }
            Keys::Wide(keys) => {
                let key = keys.get(index as usize)?;
                (key.frame.get(), key.thousandths.get())
            }
        };
        Some(CurveKey { frame, value: CurveValue::from_thousandths(thousandths) })
    }
}
