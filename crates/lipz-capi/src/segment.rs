//! Segments of a clip, and what is said in them.

use crate::bank::{Bank, opened, opened_with_texts};
use crate::clip::{Clip, of_clip};
use crate::locale::Locale;
use crate::pointer::answer;
use crate::status::{LIPZ_NONE, LIPZ_NULL_POINTER, Status};
use crate::string::c_char;
use core::mem::MaybeUninit;
use core::ptr;
use lipz_bank::ClipId;

/// A stretch of a clip, between two `|` of its Lipz file. Queries go by `clip_id` and `index`.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct Segment {
    /// The clip that this is a segment of.
    pub clip_id: u64,
    /// Place of the segment in its clip, from 0.
    pub index: u32,
    /// Its first frame.
    pub start_frame: u32,
    /// The frame behind its last one.
    pub end_frame: u32,
    /// Zero; keeps the size the same on all machines.
    pub reserved: u32,
}

impl Segment {
    pub(crate) fn from_found(segment: Option<lipz_bank::Segment<'_, '_>>) -> Result<Segment, Status> {
        let segment = segment.ok_or(LIPZ_NONE)?;
        Ok(Segment {
            clip_id: segment.clip().id().get(),
            index: segment.index(),
            start_frame: segment.start_frame(),
            end_frame: segment.end_frame(),
            reserved: 0,
        })
    }
}

/// A display text, as a player sees it: UTF-8 without terminator, in the bytes of the bank.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Text {
    /// The first byte; null only if there is no text.
    pub data: *const c_char,
    /// Length in bytes.
    pub length_bytes: usize,
    /// 1 if the clip has no text of its own in the locale, and this is that of another one.
    pub is_fallback: u32,
}

impl Default for Text {
    fn default() -> Text {
        Text { data: ptr::null(), length_bytes: 0, is_fallback: 0 }
    }
}

/// The segment of a clip with this index, a number below its `segment_count`.
#[no_mangle]
pub unsafe extern "C" fn lipz_segment_at(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    index: u32,
    segment: Option<&mut MaybeUninit<Segment>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { of_clip(bank, clip, segment, |clip| Segment::from_found(clip.segment(index))) }
}

/// The segment that a frame belongs to. Segments of no frames are never found by frame.
#[no_mangle]
pub unsafe extern "C" fn lipz_segment_of_frame(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    frame: u32,
    segment: Option<&mut MaybeUninit<Segment>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { of_clip(bank, clip, segment, |clip| Segment::from_found(clip.segment_of_frame(frame))) }
}

/// The text of a segment in a locale of the same bank. `LIPZ_NONE` if the clip has none, also by
/// fallback, and if the locale is one of another bank.
#[no_mangle]
pub unsafe extern "C" fn lipz_segment_text(
    bank: Option<&Bank>,
    segment: Option<&Segment>,
    locale: Option<&Locale>,
    text: Option<&mut MaybeUninit<Text>>,
) -> Status {
    answer(text, || {
        // SAFETY: the contract of the crate, which the caller keeps.
        let opened = unsafe { opened_with_texts(bank) }?;
        let locale = locale.ok_or(LIPZ_NULL_POINTER)?.find(&opened).ok_or(LIPZ_NONE)?;
        let text = found(&opened.bank, segment)?.text(locale).ok_or(LIPZ_NONE)?;
        let string = text.as_str();
        Ok(Text { data: string.as_ptr().cast(), length_bytes: string.len(), is_fallback: text.is_fallback().into() })
    })
}

/// Answers a query about a segment: the one of `bank` with the clip and the index of `segment`.
///
/// # Safety
/// The contract of the crate.
pub(crate) unsafe fn of_segment<T: Default>(
    bank: Option<&Bank>,
    segment: Option<&Segment>,
    out: Option<&mut MaybeUninit<T>>,
    query: impl FnOnce(&lipz_bank::Bank<'_>, lipz_bank::Segment<'_, '_>) -> Result<T, Status>,
) -> Status {
    answer(out, || {
        // SAFETY: the same contract.
        let bank = unsafe { opened(bank) }?;
        query(&bank, found(&bank, segment)?)
    })
}

fn found<'data, 'bank>(
    bank: &'bank lipz_bank::Bank<'data>,
    segment: Option<&Segment>,
) -> Result<lipz_bank::Segment<'data, 'bank>, Status> {
    let segment = segment.ok_or(LIPZ_NULL_POINTER)?;
    bank.clip(ClipId::from_u64(segment.clip_id)).and_then(|clip| clip.segment(segment.index)).ok_or(LIPZ_NONE)
}
