//! Clips: finding them, their keys and frames.

use crate::bank::{Bank, opened};
use crate::pointer::{answer, text};
use crate::status::{LIPZ_NONE, LIPZ_NULL_POINTER, Status};
use crate::string::String;
use crate::string::c_char;
use core::mem::MaybeUninit;
use lipz_bank::{ClipId, Fps};

/// Viseme type: Preston Blair's chart, `-AMOSWEFLU`.
pub const LIPZ_BLAIR: u32 = 1;
/// Viseme type: Toon Boom's chart, `-ABCDEFG`.
pub const LIPZ_TOONBOOM: u32 = 2;
/// Viseme type: loudness, `-0123456789`.
pub const LIPZ_RMS: u32 = 3;

/// One spoken line.
///
/// Queries go by `id`, and take the frame rate from here only where the bank has none. The other
/// fields are there to be read.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct Clip {
    /// Hash of the key: names the clip within its bank.
    pub id: u64,
    /// Place of the clip in the bank, for `lipz_clip_at`.
    pub slot: u32,
    /// Number of frames.
    pub frame_count: u32,
    /// Number of segments, at least 1 in a verified bank.
    pub segment_count: u32,
    /// Frames in `fps_denominator` seconds, in lowest terms; 0 if unspecified. Set both to supply it:
    /// from 1 to 1000 frames per second.
    pub fps_numerator: u32,
    /// Seconds in which `fps_numerator` frames pass; 0 if unspecified.
    pub fps_denominator: u32,
    /// `LIPZ_BLAIR`, `LIPZ_TOONBOOM`, `LIPZ_RMS`; 0 if unspecified.
    pub viseme_type: u32,
    /// 1 if the Lipz file has visemes. Without them there are no frames, and segments have no times.
    pub has_visemes: u32,
    /// 1 if the Lipz file has events.
    pub has_events: u32,
}

impl Clip {
    pub(crate) fn from_found(clip: Option<lipz_bank::Clip<'_, '_>>) -> Result<Clip, Status> {
        let clip = clip.ok_or(LIPZ_NONE)?;
        Ok(Clip {
            id: clip.id().get(),
            slot: clip.slot(),
            frame_count: clip.frame_count(),
            segment_count: clip.segment_count(),
            fps_numerator: clip.fps().map_or(0, Fps::numerator),
            fps_denominator: clip.fps().map_or(0, Fps::denominator),
            viseme_type: clip.viseme_type().map_or(0, |kind| kind as u32),
            has_visemes: clip.has_visemes().into(),
            has_events: clip.has_events().into(),
        })
    }
}

/// A mouth shape: its Lipz code, an ASCII character in any bank that passes verification. Rest is `-`.
#[repr(transparent)]
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Viseme(pub u8);

impl Viseme {
    pub(crate) fn from_reader(viseme: lipz_bank::Viseme) -> Viseme {
        Viseme(viseme.code())
    }
}

impl Default for Viseme {
    fn default() -> Viseme {
        Viseme::from_reader(lipz_bank::Viseme::REST)
    }
}

/// The id of the clip with this key. It never changes: `lipz ids --lang c` writes the ids of all
/// clips as constants.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_id_of_key(
    key: *const c_char,
    key_length_bytes: usize,
    id: Option<&mut MaybeUninit<u64>>,
) -> Status {
    answer(id, || {
        // SAFETY: the contract of the crate, which the caller keeps.
        Ok(ClipId::from_key(unsafe { text(key, key_length_bytes) }?).get())
    })
}

/// The clip with this id.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_by_id(bank: Option<&Bank>, id: u64, clip: Option<&mut MaybeUninit<Clip>>) -> Status {
    answer(clip, || {
        // SAFETY: the contract of the crate, which the caller keeps.
        Clip::from_found(unsafe { opened(bank) }?.clip(ClipId::from_u64(id)))
    })
}

/// The clip with this key, compared whole.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_by_key(
    bank: Option<&Bank>,
    key: *const c_char,
    key_length_bytes: usize,
    clip: Option<&mut MaybeUninit<Clip>>,
) -> Status {
    answer(clip, || {
        // SAFETY: the contract of the crate, which the caller keeps.
        let (bank, key) = unsafe { (opened(bank)?, text(key, key_length_bytes)?) };
        Clip::from_found(bank.clip_by_key(key))
    })
}

/// The clip in this slot, a number below `clip_count` of the bank. Slots are in no order that means
/// anything.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_at(bank: Option<&Bank>, slot: u32, clip: Option<&mut MaybeUninit<Clip>>) -> Status {
    answer(clip, || {
        // SAFETY: the contract of the crate, which the caller keeps.
        Clip::from_found(unsafe { opened(bank) }?.clip_at(slot))
    })
}

/// The key of a clip: the path of its Lipz file below the source root, without extension.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_key(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    key: Option<&mut MaybeUninit<String>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { of_clip(bank, clip, key, |clip| Ok(String::from_text(clip.key()))) }
}

/// The frame codes of a clip, one byte per frame.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_frames(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    frames: Option<&mut MaybeUninit<String>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { of_clip(bank, clip, frames, |clip| Ok(String::from_bytes(clip.frames()))) }
}

/// The viseme of a frame; rest outside the clip.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_viseme(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    frame: u32,
    viseme: Option<&mut MaybeUninit<Viseme>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { of_clip(bank, clip, viseme, |clip| Ok(Viseme::from_reader(clip.viseme(frame)))) }
}

/// The first microsecond at which a frame shows; that of frame `frame_count` is the length of the
/// clip. `LIPZ_NONE` without a frame rate.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_start_of_frame_us(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    frame: u32,
    time_us: Option<&mut MaybeUninit<u64>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { of_clip(bank, clip, time_us, |clip| Ok(clip.fps().ok_or(LIPZ_NONE)?.start_of_frame_us(frame))) }
}

/// The recording that a clip was made for: how long it is, and what is in its file. Compare it with the sound
/// that is about to be played.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct Recording {
    /// Length in microseconds, rounded to the nearest.
    pub length_us: u64,
    /// XXH3, 64 bits with seed 0, of all bytes of the file: what `XXH3_64bits` of xxHash gives.
    pub content_hash: u64,
}

/// What the bank says about the recording of a clip. `LIPZ_NONE` if the bank was packed without
/// recordings, or the clip had none.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_recording(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    recording: Option<&mut MaybeUninit<Recording>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe {
        of_clip(bank, clip, recording, |clip| {
            let found = clip.recording().ok_or(LIPZ_NONE)?;
            Ok(Recording { length_us: found.length_us(), content_hash: found.content_hash() })
        })
    }
}

/// Answers a query about a clip: the one of `bank` that has the id of `clip`, with the frame rate of
/// `clip` if it has none of its own.
///
/// # Safety
/// The contract of the crate.
pub(crate) unsafe fn of_clip<T: Default>(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    out: Option<&mut MaybeUninit<T>>,
    query: impl FnOnce(lipz_bank::Clip<'_, '_>) -> Result<T, Status>,
) -> Status {
    // SAFETY: the same contract.
    unsafe { of_clip_in(bank, clip, out, |_, clip| query(clip)) }
}

/// The same for queries that ask the bank, too.
///
/// # Safety
/// The contract of the crate.
pub(crate) unsafe fn of_clip_in<T: Default>(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    out: Option<&mut MaybeUninit<T>>,
    query: impl FnOnce(&lipz_bank::Bank<'_>, lipz_bank::Clip<'_, '_>) -> Result<T, Status>,
) -> Status {
    answer(out, || {
        // SAFETY: the same contract.
        let bank = unsafe { opened(bank) }?;
        let asked = clip.ok_or(LIPZ_NULL_POINTER)?;
        let clip = bank.clip(ClipId::from_u64(asked.id)).ok_or(LIPZ_NONE)?;
        // Whether it has a rate of its own: `Clip::fps` would check it, which takes longer than the query.
        let clip = match lipz_bank::Cursor::new(&clip) {
            Some(_) => clip,
            None => Fps::new(asked.fps_numerator, asked.fps_denominator).map_or(clip, |fps| clip.or_fps(fps)),
        };
        query(&bank, clip)
    })
}
