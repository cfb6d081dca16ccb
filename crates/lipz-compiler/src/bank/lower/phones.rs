//! The sections of phones.

use super::limits::too_large;
use crate::clip::Clip;
use lipz_diagnostics::Report;
use lipz_layout::{PHONES_OFFSET, PhoneClipRecord};

/// The sections of phones; empty if no clip has any.
#[derive(Default)]
pub(super) struct PhoneSections {
    pub(super) clips: Vec<PhoneClipRecord>,
    pub(super) phones: Vec<u8>,
}

/// Returns the phones of the clips, sorted by slot.
pub(super) fn phones(clips: &[Clip<'_>], slots: &[u32]) -> Result<PhoneSections, Report> {
    let mut found = PhoneSections::default();
    let with_phones = clips.iter().zip(slots).filter(|(clip, _)| !clip.phones().is_empty());
    let mut by_slot: Vec<(u32, &Clip<'_>)> = with_phones.map(|(clip, slot)| (*slot, clip)).collect();
    by_slot.sort_unstable_by_key(|(slot, _)| *slot);
    for (slot, clip) in by_slot {
        let offset = u32::try_from(found.phones.len()).ok().filter(|offset| *offset <= PHONES_OFFSET);
        let offset = offset.ok_or_else(|| too_large("phones"))?;
        found.clips.push(PhoneClipRecord { slot: slot.into(), offset_and_flags: (offset | clip.phone_flags()).into() });
        found.phones.extend_from_slice(clip.phones());
    }
    if found.phones.len() > PHONES_OFFSET as usize {
        return Err(too_large("phones"));
    }
    Ok(found)
}
