//! The sections of curves.

use super::fit;
use crate::clip::{Clip, Key};
use lipz_diagnostics::Report;
use lipz_layout::{CURVE_WIDE, CurveClipRecord, CurveKeyRecord, CurveRecord, WideCurveKeyRecord};
use zerocopy::IntoBytes;

/// The sections of curves; empty if no clip has one.
#[derive(Default)]
pub(super) struct Curves {
    pub(super) clips: Vec<CurveClipRecord>,
    pub(super) curves: Vec<CurveRecord>,
    pub(super) keys: Vec<u8>,
}

/// Bytes of a unit in which keys are counted.
const UNIT_BYTES: usize = size_of::<CurveKeyRecord>();

/// The clips that have curves, each with its index.
pub(super) fn with_curves<'c>(clips: &[Clip<'c>]) -> Vec<(usize, Clip<'c>)> {
    clips.iter().copied().enumerate().filter(|(_, clip)| clip.has_curves()).collect()
}

/// The curves of these clips in the order of their slots. `names` are those of the bank, in their order.
pub(super) fn curves(clips: &[(usize, Clip<'_>)], slots: &[u32], names: &[&str]) -> Result<Curves, Report> {
    let mut found = Curves::default();
    let mut by_slot: Vec<(u32, &Clip<'_>)> = clips.iter().map(|(at, clip)| (slots[*at], clip)).collect();
    by_slot.sort_unstable_by_key(|(slot, _)| *slot);
    for (slot, clip) in by_slot {
        let curves_first = fit(found.curves.len(), "curves")?;
        found.clips.push(CurveClipRecord { slot: slot.into(), curves_first: curves_first.into() });
        // Sorted by their names, and so by the numbers of these.
        for (name, keys) in clip.curves() {
            let number = names.binary_search(&name).map_or(0, |number| number as u32);
            let keys_first = fit(found.keys.len() / UNIT_BYTES, "curves")?.into();
            let wide = if push(keys, &mut found.keys) { CURVE_WIDE } else { 0 };
            found.curves.push(CurveRecord { keys_first, name_and_width: (number | wide).into() });
        }
    }
    fit(found.keys.len(), "curves")?;
    Ok(found)
}

/// Adds keys in as few bytes as all of them fit; whether they are wide.
fn push(keys: &[Key], to: &mut Vec<u8>) -> bool {
    let start = to.len();
    for (frame, value) in keys {
        match (u16::try_from(*frame), i16::try_from(value.thousandths())) {
            (Ok(frame), Ok(thousandths)) => {
                let key = CurveKeyRecord { frame: frame.into(), thousandths: thousandths.into() };
                to.extend_from_slice(key.as_bytes());
            }
            _ => {
                to.truncate(start);
                let wide = |(frame, value): &Key| WideCurveKeyRecord {
                    frame: (*frame).into(),
                    thousandths: value.thousandths().into(),
                };
                keys.iter().map(wide).for_each(|key| to.extend_from_slice(key.as_bytes()));
                return true;
            }
        }
    }
    false
}
