//! Segments of a clip: their frames, texts and events.

use crate::dialogue::{Dialogue, reader};
use crate::event::Event;
use crate::handle::Locale;
use crate::pointer::answer;
use crate::status::{LIPZ_NONE, LIPZ_NULL_POINTER, Status};
use crate::string::{String, c_char};
use core::mem::MaybeUninit;
use core::ptr;

/// A part of a clip, between two `|` of its Lipz file, in the version of the dialogue in which it was found.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct Segment {
    /// The clip.
    pub clip_id: u64,
    /// The version of the dialogue. In a different version, queries of the segment return `LIPZ_NONE`.
    pub version: u32,
    /// The number of the clip's file.
    pub file: u32,
    /// The number of the clip in that file.
    pub slot: u32,
    /// Index of the segment in its clip, from 0.
    pub index: u32,
    /// Its first frame.
    pub start_frame: u32,
    /// The frame after its last one.
    pub end_frame: u32,
}

/// A display text, as players see it: UTF-8 without terminator, in the bytes of a file.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Text {
    /// The first byte; null only if there is no text.
    pub data: *const c_char,
    /// Length in bytes.
    pub length_bytes: usize,
    /// 1 if the clip has no text of its own in the locale, so that this is the text of the fallback locale.
    pub is_fallback: u32,
}

impl Default for Text {
    fn default() -> Text {
        Text { data: ptr::null(), length_bytes: 0, is_fallback: 0 }
    }
}

impl Segment {
    pub(crate) fn from_found(version: u32, segment: Option<lipz_bank::Segment<'_>>) -> Result<Segment, Status> {
        let segment = segment.ok_or(LIPZ_NONE)?;
        let clip = segment.clip();
        Ok(Segment {
            clip_id: clip.id().get(),
            version,
            file: clip.file(),
            slot: clip.slot(),
            index: segment.index(),
            start_frame: segment.start_frame(),
            end_frame: segment.end_frame(),
        })
    }
}

/// Writes the display text of a segment in a locale, or in its fallback locale. `LIPZ_NONE` if neither has a text for
/// this clip, and for a locale of another version. A segment of an existing text may be empty.
#[no_mangle]
pub unsafe extern "C" fn lipz_segment_text(
    dialogue: Option<&Dialogue>,
    segment: Option<&Segment>,
    locale: Option<&Locale>,
    text: Option<&mut MaybeUninit<Text>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe {
        of_segment(dialogue, segment, text, |segment| {
            let found = segment.text(locale.ok_or(LIPZ_NULL_POINTER)?.to_reader()).ok_or(LIPZ_NONE)?;
            let String { data, length_bytes } = String::from_text(found.as_str());
            Ok(Text { data, length_bytes, is_fallback: found.is_fallback().into() })
        })
    }
}

/// Writes the event string of a segment, trimmed and otherwise as in the Lipz file. Empty if there are no events in
/// this segment; `LIPZ_NONE` if the file has no events.
#[no_mangle]
pub unsafe extern "C" fn lipz_segment_event_string(
    dialogue: Option<&Dialogue>,
    segment: Option<&Segment>,
    string: Option<&mut MaybeUninit<String>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { of_segment(dialogue, segment, string, |segment| Ok(String::from_text(segment.event().ok_or(LIPZ_NONE)?))) }
}

/// Writes the typed event of a segment with this index. Call it from 0 on until `LIPZ_NONE`. An event string in a
/// different syntax, such as a script, has no typed events.
#[no_mangle]
pub unsafe extern "C" fn lipz_segment_event(
    dialogue: Option<&Dialogue>,
    segment: Option<&Segment>,
    index: u32,
    event: Option<&mut MaybeUninit<Event>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe {
        of_segment(dialogue, segment, event, |segment| {
            Ok(Event::from_reader(segment.events().nth(index as usize).ok_or(LIPZ_NONE)?))
        })
    }
}

/// Answers a query about a segment.
///
/// # Safety
/// The contract of the crate.
unsafe fn of_segment<'a, T: Default>(
    dialogue: Option<&'a Dialogue>,
    segment: Option<&Segment>,
    out: Option<&mut MaybeUninit<T>>,
    query: impl FnOnce(lipz_bank::Segment<'a>) -> Result<T, Status>,
) -> Status {
    answer(out, || {
        // SAFETY: the same contract.
        let dialogue = unsafe { reader(dialogue) }?;
        let asked = segment.ok_or(LIPZ_NULL_POINTER)?;
        let clip = if asked.version == dialogue.version() { dialogue.clip_at(asked.file, asked.slot) } else { None };
        let clip = clip.filter(|clip| clip.id().get() == asked.clip_id).ok_or(LIPZ_NONE)?;
        query(clip.segment(asked.index).ok_or(LIPZ_NONE)?)
    })
}
