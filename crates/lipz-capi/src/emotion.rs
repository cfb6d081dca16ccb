//! What a character of a clip feels at a time: the values of the twelve attributes of emotion.

use crate::bank::Bank;
use crate::clip::{Clip, of_clip};
use crate::status::Status;
use crate::who::{self, Who};
use core::mem::MaybeUninit;
use lipz_bank::{Micros, Samples, Seconds, Time};

/// Attribute of emotion: `sadness`, place in `thousandths`.
pub const LIPZ_SADNESS: u32 = 0;
/// Attribute of emotion: `anger`.
pub const LIPZ_ANGER: u32 = 1;
/// Attribute of emotion: `joy`.
pub const LIPZ_JOY: u32 = 2;
/// Attribute of emotion: `fear`.
pub const LIPZ_FEAR: u32 = 3;
/// Attribute of emotion: `disgust`.
pub const LIPZ_DISGUST: u32 = 4;
/// Attribute of emotion: `surprise`.
pub const LIPZ_SURPRISE: u32 = 5;
/// Attribute of emotion: `shock`.
pub const LIPZ_SHOCK: u32 = 6;
/// Attribute of emotion: `perplexed`.
pub const LIPZ_PERPLEXED: u32 = 7;
/// Attribute of emotion: `asleep`.
pub const LIPZ_ASLEEP: u32 = 8;
/// Attribute of emotion: `pain`.
pub const LIPZ_PAIN: u32 = 9;
/// Attribute of emotion: `exertion`.
pub const LIPZ_EXERTION: u32 = 10;
/// Attribute of emotion: `shout`.
pub const LIPZ_SHOUT: u32 = 11;
/// How many attributes of emotion there are.
pub const LIPZ_EMOTION_COUNT: usize = 12;
/// `strongest` of a neutral face.
pub const LIPZ_NEUTRAL: u32 = 0xFFFF_FFFF;

/// What a character feels: all zeros for a neutral face.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Emotions {
    /// Values in thousandths, 0 to 10,000 where the file says nothing else: `thousandths[LIPZ_ANGER]`.
    pub thousandths: [i32; LIPZ_EMOTION_COUNT],
    /// The attribute with the highest value, `LIPZ_NEUTRAL` if none is above 0.
    pub strongest: u32,
    /// The sum of all values, in thousandths.
    pub sum: i32,
}

impl Default for Emotions {
    fn default() -> Emotions {
        Emotions { thousandths: [0; LIPZ_EMOTION_COUNT], strongest: LIPZ_NEUTRAL, sum: 0 }
    }
}

/// What the speaker feels `time_us` microseconds after the audio began. A neutral face without a frame rate.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_emotions_at_us(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    time_us: i64,
    emotions: Option<&mut MaybeUninit<Emotions>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { of_clip(bank, clip, emotions, |clip| Ok(from_found(&clip.emotions_at(Micros(time_us))))) }
}

/// What the speaker feels after `position` samples at `rate_hz`.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_emotions_at_samples(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    position: i64,
    rate_hz: u32,
    emotions: Option<&mut MaybeUninit<Emotions>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { of_clip(bank, clip, emotions, |clip| Ok(from_found(&clip.emotions_at(Samples { position, rate_hz })))) }
}

/// What the speaker feels after `seconds`.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_emotions_at_seconds(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    seconds: f64,
    emotions: Option<&mut MaybeUninit<Emotions>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { of_clip(bank, clip, emotions, |clip| Ok(from_found(&clip.emotions_at(Seconds(seconds))))) }
}

/// `lipz_clip_emotions_at_seconds` for clocks that have no `double`.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_emotions_at_seconds_f32(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    seconds: f32,
    emotions: Option<&mut MaybeUninit<Emotions>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { of_clip(bank, clip, emotions, |clip| Ok(from_found(&clip.emotions_at(Seconds(seconds))))) }
}

/// What a character of the clip feels `time_us` microseconds after the audio began: `mara feels fear 4` in its events is
/// in the curve `mara.fear`. A neutral face without such curves. `who` may be null for the speaker.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_emotions_of_us(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    who: Option<&Who>,
    time_us: i64,
    emotions: Option<&mut MaybeUninit<Emotions>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { of(bank, clip, who, Micros(time_us), emotions) }
}

/// What a character of the clip feels after `position` samples at `rate_hz`.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_emotions_of_samples(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    who: Option<&Who>,
    position: i64,
    rate_hz: u32,
    emotions: Option<&mut MaybeUninit<Emotions>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { of(bank, clip, who, Samples { position, rate_hz }, emotions) }
}

/// What a character of the clip feels after `seconds`.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_emotions_of_seconds(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    who: Option<&Who>,
    seconds: f64,
    emotions: Option<&mut MaybeUninit<Emotions>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { of(bank, clip, who, Seconds(seconds), emotions) }
}

/// `lipz_clip_emotions_of_seconds` for clocks that have no `double`.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_emotions_of_seconds_f32(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    who: Option<&Who>,
    seconds: f32,
    emotions: Option<&mut MaybeUninit<Emotions>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { of(bank, clip, who, Seconds(seconds), emotions) }
}

/// # Safety
///
/// The contract of the crate.
unsafe fn of(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    who: Option<&Who>,
    time: impl Time,
    emotions: Option<&mut MaybeUninit<Emotions>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { of_clip(bank, clip, emotions, |clip| Ok(from_found(&clip.emotions_of(who::of_reader(who)?, time)))) }
}

fn from_found(found: &lipz_bank::Emotions) -> Emotions {
    let mut emotions = Emotions { sum: found.sum().thousandths(), ..Emotions::default() };
    for (place, (_, value)) in emotions.thousandths.iter_mut().zip(found.iter()) {
        *place = value.thousandths();
    }
    emotions.strongest = found.strongest().map_or(LIPZ_NEUTRAL, |(emotion, _)| emotion as u32);
    emotions
}
