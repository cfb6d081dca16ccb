//! What shows at a time, in the units that audio engines report.
//!
//! Each unit leads to the frame number of exact arithmetic. Times before the start, from the end on,
//! infinite or not a number lead to no frame, and so to rest.

use crate::bank::Bank;
use crate::clip::{Clip, Viseme, of_clip};
use crate::segment::Segment;
use crate::status::{LIPZ_NONE, Status};
use core::mem::MaybeUninit;
use lipz_bank::{Micros, Samples, Seconds};

/// The frame that shows `time_us` microseconds after the audio began: the fastest unit.
#[no_mangle]
pub unsafe extern "C" fn lipz_frame_at_us(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    time_us: i64,
    frame: Option<&mut MaybeUninit<u32>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { of_clip(bank, clip, frame, |clip| clip.frame_at(Micros(time_us)).ok_or(LIPZ_NONE)) }
}

/// The frame that shows after `position` samples (per channel) at `rate_hz` samples per second.
#[no_mangle]
pub unsafe extern "C" fn lipz_frame_at_samples(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    position: i64,
    rate_hz: u32,
    frame: Option<&mut MaybeUninit<u32>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { of_clip(bank, clip, frame, |clip| clip.frame_at(Samples { position, rate_hz }).ok_or(LIPZ_NONE)) }
}

/// The frame that shows after `seconds`, taken two units in the last place later, so that `n / fps`
/// leads to frame `n`. Where your engine offers an integer clock, use the other units.
#[no_mangle]
pub unsafe extern "C" fn lipz_frame_at_seconds(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    seconds: f64,
    frame: Option<&mut MaybeUninit<u32>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { of_clip(bank, clip, frame, |clip| clip.frame_at(Seconds(seconds)).ok_or(LIPZ_NONE)) }
}

/// `lipz_frame_at_seconds` for clocks that have no `double`. The last place of a `float` is coarse: `n / fps`
/// leads to frame `n` up to 2^21 only, a day at 24 fps.
#[no_mangle]
pub unsafe extern "C" fn lipz_frame_at_seconds_f32(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    seconds: f32,
    frame: Option<&mut MaybeUninit<u32>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { of_clip(bank, clip, frame, |clip| clip.frame_at(Seconds(seconds)).ok_or(LIPZ_NONE)) }
}

/// The viseme that shows `time_us` microseconds after the audio began; rest when nobody speaks.
#[no_mangle]
pub unsafe extern "C" fn lipz_viseme_at_us(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    time_us: i64,
    viseme: Option<&mut MaybeUninit<Viseme>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { of_clip(bank, clip, viseme, |clip| Ok(Viseme::from_reader(clip.viseme_at(Micros(time_us))))) }
}

/// The viseme that shows after `position` samples at `rate_hz`; rest when nobody speaks.
#[no_mangle]
pub unsafe extern "C" fn lipz_viseme_at_samples(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    position: i64,
    rate_hz: u32,
    viseme: Option<&mut MaybeUninit<Viseme>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe {
        of_clip(bank, clip, viseme, |clip| Ok(Viseme::from_reader(clip.viseme_at(Samples { position, rate_hz }))))
    }
}

/// The viseme that shows after `seconds`, with the rule of `lipz_frame_at_seconds`; rest when nobody
/// speaks.
#[no_mangle]
pub unsafe extern "C" fn lipz_viseme_at_seconds(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    seconds: f64,
    viseme: Option<&mut MaybeUninit<Viseme>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { of_clip(bank, clip, viseme, |clip| Ok(Viseme::from_reader(clip.viseme_at(Seconds(seconds))))) }
}

/// `lipz_viseme_at_seconds` for clocks that have no `double`.
#[no_mangle]
pub unsafe extern "C" fn lipz_viseme_at_seconds_f32(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    seconds: f32,
    viseme: Option<&mut MaybeUninit<Viseme>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { of_clip(bank, clip, viseme, |clip| Ok(Viseme::from_reader(clip.viseme_at(Seconds(seconds))))) }
}

/// The segment `time_us` microseconds after the audio began.
#[no_mangle]
pub unsafe extern "C" fn lipz_segment_at_us(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    time_us: i64,
    segment: Option<&mut MaybeUninit<Segment>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { of_clip(bank, clip, segment, |clip| Segment::from_found(clip.segment_at(Micros(time_us)))) }
}

/// The segment after `position` samples at `rate_hz`.
#[no_mangle]
pub unsafe extern "C" fn lipz_segment_at_samples(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    position: i64,
    rate_hz: u32,
    segment: Option<&mut MaybeUninit<Segment>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { of_clip(bank, clip, segment, |clip| Segment::from_found(clip.segment_at(Samples { position, rate_hz }))) }
}

/// The segment after `seconds`, with the rule of `lipz_frame_at_seconds`.
#[no_mangle]
pub unsafe extern "C" fn lipz_segment_at_seconds(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    seconds: f64,
    segment: Option<&mut MaybeUninit<Segment>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { of_clip(bank, clip, segment, |clip| Segment::from_found(clip.segment_at(Seconds(seconds)))) }
}

/// `lipz_segment_at_seconds` for clocks that have no `double`.
#[no_mangle]
pub unsafe extern "C" fn lipz_segment_at_seconds_f32(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    seconds: f32,
    segment: Option<&mut MaybeUninit<Segment>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { of_clip(bank, clip, segment, |clip| Segment::from_found(clip.segment_at(Seconds(seconds)))) }
}
