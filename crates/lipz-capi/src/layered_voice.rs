//! Voices of a stack.

use crate::bank::{Bank, opened};
use crate::layers::{LayeredClip, bank_at, find};
use crate::pointer::{answer, text};
use crate::status::{LIPZ_NONE, Status};
use crate::string::{String, c_char};
use crate::voice::{LIPZ_ORIGINAL, number_of};
use core::mem::MaybeUninit;
use lipz_bank::{ClipId, Stacked, original_of, played_in, voice_tags};

/// A clip of a stack as it is played in a voice.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct LayeredVoicedClip {
    /// The clip: its mouth, its times, its texts and its events are those of the recording in that voice.
    pub clip: LayeredClip,
    /// `LIPZ_ORIGINAL`, `LIPZ_DUB` or `LIPZ_OTHER_DUB`.
    pub spoken: u32,
    /// 0.
    pub reserved: u32,
}

/// The clip with this id as it is played in the voice with this tag (`de-de`), spelled as in the banks. The id may be that of
/// the original or of any of its dubs. `LIPZ_NONE` if the stack has no such clip, or no such voice: play the clip as it is.
#[no_mangle]
pub unsafe extern "C" fn lipz_layers_clip_in_voice(
    banks: *const Bank,
    count: u32,
    id: u64,
    tag: *const c_char,
    tag_length_bytes: usize,
    voiced: Option<&mut MaybeUninit<LayeredVoicedClip>>,
) -> Status {
    answer(voiced, || {
        // SAFETY: the contract of the crate, which the caller keeps.
        let tag = unsafe { text(tag, tag_length_bytes) }?;
        let stack = Array { banks, count };
        let mut tags = voice_tags(&stack);
        if !tags.any(|voice| voice == tag) {
            return Err(LIPZ_NONE);
        }
        let id = ClipId::from_u64(id);
        let original = original_of(&stack, id).map_or(id, |(_, original)| original);
        let played = played_in(&stack, original, tag);
        let spoken = played.map_or(LIPZ_ORIGINAL, |(_, spoken)| number_of(spoken));
        // SAFETY: the same contract.
        let clip = unsafe { find(banks, count, played.map_or(original, |(id, _)| id)) }?;
        Ok(LayeredVoicedClip { clip, spoken, reserved: 0 })
    })
}

/// The tag of the voice whose recording the mouth of the clip with this id belongs to. `LIPZ_NONE` in a stack without dubs.
#[no_mangle]
pub unsafe extern "C" fn lipz_layers_clip_voice(
    banks: *const Bank,
    count: u32,
    id: u64,
    tag: Option<&mut MaybeUninit<String>>,
) -> Status {
    answer(tag, || {
        let stack = Array { banks, count };
        let of_dub = original_of(&stack, ClipId::from_u64(id)).map(|(tag, _)| tag);
        Ok(String::from_text(of_dub.or_else(|| voice_tags(&stack).next()).ok_or(LIPZ_NONE)?))
    })
}

/// The tag of the voice of a stack with this index: that of the originals is 0, those of the dubs follow in the order of their
/// tags. `LIPZ_NONE` behind the last; a stack without dubs has none.
#[no_mangle]
pub unsafe extern "C" fn lipz_layers_voice_at(
    banks: *const Bank,
    count: u32,
    index: u32,
    tag: Option<&mut MaybeUninit<String>>,
) -> Status {
    answer(tag, || {
        let stack = Array { banks, count };
        let tag = voice_tags(&stack).nth(index as usize);
        Ok(String::from_text(tag.ok_or(LIPZ_NONE)?))
    })
}

/// The banks of a caller, who keeps the contract of the crate.
pub(crate) struct Array {
    pub(crate) banks: *const Bank,
    pub(crate) count: u32,
}

impl<'data> Stacked<'data> for Array {
    fn bank_at(&self, at: usize) -> Option<lipz_bank::Bank<'data>> {
        let at = u32::try_from(at).ok().filter(|at| *at < self.count)?;
        // SAFETY: there are so many banks, and the caller keeps them and their bytes.
        unsafe { opened(bank_at(self.banks, at)) }.ok()
    }

    fn segment_count(&self, id: ClipId) -> Option<u32> {
        let mut at = self.count as usize;
        while let Some(below) = at.checked_sub(1) {
            at = below;
            let bank = self.bank_at(at)?;
            let layer = bank.layer();
            match bank.clip(id) {
                Some(clip) if layer.map_or(true, |layer| layer.parts(clip.slot()).0) => {
                    return Some(clip.segment_count());
                }
                None if layer.map_or(false, |layer| layer.removes(id)) => return None,
                _ => {}
            }
        }
        None
    }
}
