//! The sections of voices, which list the dubs.

use super::limits::fit;
use crate::locales::dubs::Dubs;
use lipz_diagnostics::Report;
use lipz_layout::{DUB_OF, NO_DUB, OTHER_DUB, U32};

/// Both sections; empty if there are no dubs.
#[derive(Default)]
pub(super) struct Voices {
    pub(super) tags: Vec<u8>,
    pub(super) dubs: Vec<U32>,
}

/// Returns the voices of a bank whose clips are in these slots.
pub(super) fn voices(dubs: &Dubs, slots: &[u32]) -> Result<Voices, Report> {
    let mut found = Voices::default();
    if dubs.voices.is_empty() {
        return Ok(found);
    }
    for tag in &dubs.voices {
        found.tags.extend(tag.bytes().chain([0]));
    }
    let clip_count = slots.len();
    fit((dubs.voices.len() - 1) * clip_count * size_of::<U32>(), "voices")?;
    found.dubs = vec![U32::new(NO_DUB); (dubs.voices.len() - 1) * clip_count];
    let place = |voice: usize, slot: u32| (voice - 1) * clip_count + slot as usize;
    for (at, dub) in dubs.iter() {
        let (own, original) = (slots[at], slots[dub.original]);
        found.dubs[place(dub.voice, own)] = (original | DUB_OF).into();
        found.dubs[place(dub.voice, original)] = own.into();
    }
    for (dub, other) in &dubs.others {
        found.dubs[place(dub.voice, slots[dub.original])] = (slots[*other] | OTHER_DUB).into();
    }
    Ok(found)
}
