//! The sections of curves.

use super::limits::fit;
use crate::clip::{Clip, Key};
use lipz_diagnostics::Report;
use lipz_layout::{CURVE_WIDE, CurveClipRecord, CurveKeyRecord, CurveRecord, WideCurveKeyRecord};
use zerocopy::IntoBytes;

/// The sections of curves; empty if no clip has one.
#[derive(Default)]
pub(super) struct CurveSections {
    pub(super) clips: Vec<CurveClipRecord>,
    pub(super) curves: Vec<CurveRecord>,
    pub(super) keys: Vec<u8>,
}

/// The unit in which keys are counted, in bytes.
const UNIT_BYTES: usize = size_of::<CurveKeyRecord>();

/// Returns the clips with curves, each with its index.
pub(super) fn with_curves<'c>(clips: &[Clip<'c>]) -> Vec<(usize, Clip<'c>)> {
    clips.iter().copied().enumerate().filter(|(_, clip)| clip.has_curves()).collect()
}

/// Returns the curves of these clips, sorted by slot. `names` are the sorted names of the bank.
pub(super) fn curves(clips: &[(usize, Clip<'_>)], slots: &[u32], names: &[&str]) -> Result<CurveSections, Report> {
    let mut found = CurveSections::default();
    let mut by_slot: Vec<(u32, &Clip<'_>)> = clips.iter().map(|(at, clip)| (slots[*at], clip)).collect();
    by_slot.sort_unstable_by_key(|(slot, _)| *slot);
    for (slot, clip) in by_slot {
        let curves_first = fit(found.curves.len(), "curves")?;
        found.clips.push(CurveClipRecord { slot: slot.into(), curves_first: curves_first.into() });
        // They are sorted by name, and therefore by the number of the name.
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

/// Adds keys in the shortest encoding that fits all of them. Returns whether that is the wide one.
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
