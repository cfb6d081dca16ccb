//! All clips of a bank, as the check made them.

use super::old_bank::OldBank;
use super::recall::Recall;
use crate::clip::{ClipData, Clips};
use lipz_bank::Bank;

/// The clips of a verified bank in the order of their keys; `None` if one cannot be recalled.
pub(crate) fn clips_of(bank: Vec<u8>) -> Option<Clips> {
    let old = OldBank::Whole(bank.into());
    let recall = Recall::new(&old)?;
    let (mut clips, mut clip) = (Clips::default(), ClipData::default());
    let mut recaller = recall.recaller(&mut clips.locales);
    for found in Bank::open(old.tables()).ok()?.clips() {
        recaller.clip(found.slot(), &mut clip)?;
        clips.push(found.key(), &clip);
    }
    Some(clips)
}
