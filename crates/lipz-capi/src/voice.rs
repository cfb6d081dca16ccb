//! Voices: languages with recordings of their own, whose mouths are dubs.

use crate::bank::{Bank, opened};
use crate::clip::{Clip, of_clip};
use crate::pointer::{answer, text};
use crate::status::{LIPZ_NONE, Status};
use crate::string::String;
use crate::string::c_char;
use core::mem::MaybeUninit;
use lipz_bank::Spoken;

/// What is played is the original: the line is not dubbed, or the original was asked for.
pub const LIPZ_ORIGINAL: u32 = 0;
/// What is played is the dub in the voice that was asked for.
pub const LIPZ_DUB: u32 = 1;
/// What is played is the dub in another voice, which the one that was asked for falls back to.
pub const LIPZ_OTHER_DUB: u32 = 2;

/// A clip as it is played in a voice.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct VoicedClip {
    /// The clip: its mouth, its times, its texts and its events are those of the recording in that voice.
    pub clip: Clip,
    /// `LIPZ_ORIGINAL`, `LIPZ_DUB` or `LIPZ_OTHER_DUB`.
    pub spoken: u32,
    /// 0.
    pub reserved: u32,
}

/// The clip as it is played in the voice with this tag (`de-de`), spelled as in the bank. `clip` may be the original or any
/// of its dubs. `LIPZ_NONE` if the bank has no such voice: play the clip as it is.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_in_voice(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    tag: *const c_char,
    tag_length_bytes: usize,
    voiced: Option<&mut MaybeUninit<VoicedClip>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe {
        of_clip(bank, clip, voiced, |clip| {
            let (bank, tag) = (opened(bank)?, text(tag, tag_length_bytes)?);
            let voiced = clip.in_voice(bank.voice(tag).ok_or(LIPZ_NONE)?);
            let spoken = number_of(voiced.spoken);
            Ok(VoicedClip { clip: Clip::from_found(Some(voiced.clip))?, spoken, reserved: 0 })
        })
    }
}

/// The number of whose mouth a clip has.
pub(crate) fn number_of(spoken: Spoken) -> u32 {
    match spoken {
        Spoken::Dub => LIPZ_DUB,
        Spoken::OtherDub => LIPZ_OTHER_DUB,
        _ => LIPZ_ORIGINAL,
    }
}

/// The tag of the voice whose recording the mouth of a clip belongs to. `LIPZ_NONE` in a bank without dubs.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_voice(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    tag: Option<&mut MaybeUninit<String>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { of_clip(bank, clip, tag, |clip| Ok(String::from_text(clip.voice().ok_or(LIPZ_NONE)?.tag()))) }
}

/// The tag of the voice with this index: that of the originals is 0, those of the dubs follow in the order of their tags.
/// `LIPZ_NONE` behind the last; a bank without dubs has none.
#[no_mangle]
pub unsafe extern "C" fn lipz_voice_at(
    bank: Option<&Bank>,
    index: u32,
    tag: Option<&mut MaybeUninit<String>>,
) -> Status {
    answer(tag, || {
        // SAFETY: the contract of the crate, which the caller keeps.
        let voice = unsafe { opened(bank) }?.voices().nth(index as usize);
        Ok(String::from_text(voice.ok_or(LIPZ_NONE)?.tag()))
    })
}
