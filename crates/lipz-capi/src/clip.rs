//! Clips: finding them, their keys and frames.

use crate::dialogue::{Dialogue, reader};
use crate::handle::Voice;
use crate::pointer::answer;
use crate::segment::Segment;
use crate::status::{LIPZ_NONE, LIPZ_NULL_POINTER, Status};
use crate::string::String;
use crate::time::Time;
use core::mem::MaybeUninit;
use lipz_bank::playback::ConsonantHold;
use lipz_bank::{Fps, VisemeType, VoiceSource};

/// Viseme type: Preston Blair's chart, `-AMOSWEFLU`.
pub const LIPZ_BLAIR: u32 = 1;
/// Viseme type: Toon Boom's chart, `-ABCDEFG`.
pub const LIPZ_TOONBOOM: u32 = 2;
/// Viseme type: loudness, `-0123456789`.
pub const LIPZ_RMS: u32 = 3;

/// The clip is the original: the line is not dubbed, or the original was requested.
pub const LIPZ_ORIGINAL: u32 = 0;
/// The clip is the dub in the requested voice.
pub const LIPZ_DUB: u32 = 1;
/// The clip is the dub in a voice that the requested one falls back to.
pub const LIPZ_OTHER_DUB: u32 = 2;

/// One spoken line, in the version of the dialogue in which it was found. Read the fields, and set only the frame rate
/// and the viseme type where they are 0.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct Clip {
    /// Hash of the key, which identifies the clip in every version.
    pub id: u64,
    /// The version of the dialogue. In a different version, queries of the clip return `LIPZ_NONE`.
    pub version: u32,
    /// The number of its file.
    pub file: u32,
    /// Its number in that file.
    pub slot: u32,
    /// Number of frames.
    pub frame_count: u32,
    /// Number of segments, at least 1 in a verified bank.
    pub segment_count: u32,
    /// Frames per `fps_denominator` seconds, in lowest terms; 0 if unspecified. In that case, you can set both fields,
    /// to between 1 and 1000 frames per second.
    pub fps_numerator: u32,
    /// Seconds in which `fps_numerator` frames pass; 0 if unspecified.
    pub fps_denominator: u32,
    /// `LIPZ_BLAIR`, `LIPZ_TOONBOOM`, `LIPZ_RMS`; 0 if unspecified. In that case, you can set it.
    pub viseme_type: u32,
    /// 1 if the Lipz file has visemes. Without them there are no frames, and segments have no times.
    pub has_visemes: u32,
    /// 1 if the Lipz file has events.
    pub has_events: u32,
}

impl Clip {
    pub(crate) fn from_reader(version: u32, clip: &lipz_bank::Clip<'_>) -> Clip {
        Clip {
            id: clip.id().get(),
            version,
            file: clip.file(),
            slot: clip.slot(),
            frame_count: clip.frame_count(),
            segment_count: clip.segment_count(),
            fps_numerator: clip.fps().map_or(0, Fps::numerator),
            fps_denominator: clip.fps().map_or(0, Fps::denominator),
            viseme_type: clip.viseme_type().map_or(0, |kind| kind as u32),
            has_visemes: clip.has_visemes().into(),
            has_events: clip.has_events().into(),
        }
    }

    /// Returns the reader's clip, with the struct's frame rate and viseme type where it has none.
    pub(crate) fn find<'a>(&self, dialogue: &'a lipz_bank::Dialogue<'a>) -> Result<lipz_bank::Clip<'a>, Status> {
        let found = if self.version == dialogue.version() { dialogue.clip_at(self.file, self.slot) } else { None };
        let found = found.filter(|clip| clip.id().get() == self.id).ok_or(LIPZ_NONE)?;
        Ok(given(found, self.fps_numerator, self.fps_denominator, self.viseme_type))
    }
}

/// Sets frame rate and viseme type on a clip where it has none.
pub(crate) fn given(clip: lipz_bank::Clip<'_>, numerator: u32, denominator: u32, kind: u32) -> lipz_bank::Clip<'_> {
    let kind = u8::try_from(kind).ok().and_then(VisemeType::from_number);
    let clip = kind.map_or(clip, |kind| clip.or_viseme_type(kind));
    // Detects whether the clip has its own rate. `Clip::fps` would check the rate, which takes longer than most
    // queries.
    match lipz_bank::Cursor::new(&clip) {
        Some(_) => clip,
        None => Fps::new(numerator, denominator).map_or(clip, |fps| clip.or_fps(fps)),
    }
}

/// A viseme: its Lipz code, an ASCII character in any bank that passes verification. Rest is `-`.
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

/// The recording that a clip was made for. Compare it with the audio that you are about to play.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct Recording {
    /// Length in microseconds, rounded to the nearest.
    pub length_us: u64,
    /// XXH3, 64 bits with seed 0, of all bytes of the file: the result of `XXH3_64bits` of xxHash.
    pub content_hash: u64,
}

/// A clip as played in a voice.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct VoicedClip {
    /// The clip. Its visemes, times, texts and events belong to the recording in that voice.
    pub clip: Clip,
    /// `LIPZ_ORIGINAL`, `LIPZ_DUB` or `LIPZ_OTHER_DUB`.
    pub spoken: u32,
    /// 0.
    pub reserved: u32,
}

/// Writes the key of a clip: the path of its Lipz file below the source root, without extension.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_key(
    dialogue: Option<&Dialogue>,
    clip: Option<&Clip>,
    key: Option<&mut MaybeUninit<String>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { of_clip(dialogue, clip, key, |_, clip| Ok(String::from_text(clip.key()))) }
}

/// Writes the frame codes of a clip, one byte per frame.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_frames(
    dialogue: Option<&Dialogue>,
    clip: Option<&Clip>,
    frames: Option<&mut MaybeUninit<String>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { of_clip(dialogue, clip, frames, |_, clip| Ok(String::from_bytes(clip.frames()))) }
}

/// Writes the frame at a time.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_frame_at(
    dialogue: Option<&Dialogue>,
    clip: Option<&Clip>,
    time: Time,
    frame: Option<&mut MaybeUninit<u32>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { of_clip(dialogue, clip, frame, |_, clip| clip.frame_at(time.to_reader()).ok_or(LIPZ_NONE)) }
}

/// Writes the viseme of a frame, or rest outside the clip.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_viseme(
    dialogue: Option<&Dialogue>,
    clip: Option<&Clip>,
    frame: u32,
    viseme: Option<&mut MaybeUninit<Viseme>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { of_clip(dialogue, clip, viseme, |_, clip| Ok(Viseme::from_reader(clip.viseme(frame)))) }
}

/// Writes the viseme at a time, or rest while the character does not speak.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_viseme_at(
    dialogue: Option<&Dialogue>,
    clip: Option<&Clip>,
    time: Time,
    viseme: Option<&mut MaybeUninit<Viseme>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { of_clip(dialogue, clip, viseme, |_, clip| Ok(Viseme::from_reader(clip.viseme_at(time.to_reader())))) }
}

/// Writes the segment of a clip with this index.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_segment(
    dialogue: Option<&Dialogue>,
    clip: Option<&Clip>,
    index: u32,
    segment: Option<&mut MaybeUninit<Segment>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe {
        of_clip(dialogue, clip, segment, |dialogue, clip| Segment::from_found(dialogue.version(), clip.segment(index)))
    }
}

/// Writes the segment at a time.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_segment_at(
    dialogue: Option<&Dialogue>,
    clip: Option<&Clip>,
    time: Time,
    segment: Option<&mut MaybeUninit<Segment>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe {
        of_clip(dialogue, clip, segment, |dialogue, clip| {
            Segment::from_found(dialogue.version(), clip.segment_at(time.to_reader()))
        })
    }
}

/// Writes the first microsecond of a frame. For frame `frame_count`, it is the length of the clip; for frame 1, the
/// `lead_us` of a cursor that leads by one frame. `LIPZ_NONE` without a frame rate.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_start_of_frame_us(
    dialogue: Option<&Dialogue>,
    clip: Option<&Clip>,
    frame: u32,
    time_us: Option<&mut MaybeUninit<u64>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { of_clip(dialogue, clip, time_us, |_, clip| Ok(clip.fps().ok_or(LIPZ_NONE)?.start_of_frame_us(frame))) }
}

/// Writes the `hold_frames` of a cursor for a display with rendered frames of this length in microseconds. Every
/// consonant with enough room is then in at least one. For 0, writes two frames at 24 fps, the minimum that can be
/// read. `LIPZ_NONE` without a frame rate.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_hold_frames(
    dialogue: Option<&Dialogue>,
    clip: Option<&Clip>,
    rendered_frame_us: u32,
    hold_frames: Option<&mut MaybeUninit<u32>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe {
        of_clip(dialogue, clip, hold_frames, |_, clip| {
            let fps = clip.fps().ok_or(LIPZ_NONE)?;
            let hold = match rendered_frame_us {
                0 => ConsonantHold::readable(fps),
                us => ConsonantHold::for_display(us, fps),
            };
            Ok(hold.frame_count().into())
        })
    }
}

/// Writes the bank's data about the recording of a clip. `LIPZ_NONE` if the bank was packed without recordings, or the
/// clip had no recording.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_recording(
    dialogue: Option<&Dialogue>,
    clip: Option<&Clip>,
    recording: Option<&mut MaybeUninit<Recording>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe {
        of_clip(dialogue, clip, recording, |_, clip| {
            let found = clip.recording().ok_or(LIPZ_NONE)?;
            Ok(Recording { length_us: found.length_us(), content_hash: found.content_hash() })
        })
    }
}

/// Writes the clip as played in `voice`: its dub, or the dub in a voice that this one falls back to, or the original.
/// The clip may be the original or any of its dubs. With a voice of another version, writes the clip itself.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_in_voice(
    dialogue: Option<&Dialogue>,
    clip: Option<&Clip>,
    voice: Option<&Voice>,
    voiced: Option<&mut MaybeUninit<VoicedClip>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe {
        of_clip(dialogue, clip, voiced, |dialogue, clip| {
            let found = clip.in_voice(voice.ok_or(LIPZ_NULL_POINTER)?.to_reader());
            let spoken = match found.spoken {
                VoiceSource::Dub => LIPZ_DUB,
                VoiceSource::OtherDub => LIPZ_OTHER_DUB,
                _ => LIPZ_ORIGINAL,
            };
            Ok(VoicedClip { clip: Clip::from_reader(dialogue.version(), &found.clip), spoken, reserved: 0 })
        })
    }
}

/// Writes the voice of the recording that a clip was made for. `LIPZ_NONE` without dubs.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_voice(
    dialogue: Option<&Dialogue>,
    clip: Option<&Clip>,
    voice: Option<&mut MaybeUninit<Voice>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe {
        of_clip(dialogue, clip, voice, |dialogue, clip| {
            Ok(Voice::from_reader(dialogue, clip.voice().ok_or(LIPZ_NONE)?))
        })
    }
}

/// Answers a query about a clip.
///
/// # Safety
/// The contract of the crate.
pub(crate) unsafe fn of_clip<'a, T: Default>(
    dialogue: Option<&'a Dialogue>,
    clip: Option<&Clip>,
    out: Option<&mut MaybeUninit<T>>,
    query: impl FnOnce(&'a lipz_bank::Dialogue<'a>, lipz_bank::Clip<'a>) -> Result<T, Status>,
) -> Status {
    answer(out, || {
        // SAFETY: the same contract.
        let dialogue = unsafe { reader(dialogue) }?;
        query(dialogue, clip.ok_or(LIPZ_NULL_POINTER)?.find(dialogue)?)
    })
}
