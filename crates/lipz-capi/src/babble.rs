//! Mouths without a clip's shapes: babble, openness, and what lead and hold are in frames of a clip.

use crate::bank::{Bank, opened, origin};
use crate::clip::{Clip, Viseme};
use crate::pointer::{answer, text};
use crate::status::{LIPZ_NONE, LIPZ_NULL_POINTER, Status};
use crate::string::{String, c_char};
use core::mem::MaybeUninit;
use lipz_bank::{ConsonantHold, Fps, Lead, Micros, Power, Samples, Seconds, Time, VisemeType, VoiceLevel};

/// The `index` of the Second Life viewer's own profile, which needs no bank.
pub const LIPZ_BUILT_IN: u32 = 0xFFFF_FFFF;
/// The level of a voice that nobody measures: three quarters, where all digits of the viewer's profile show, but not at
/// their widest.
pub const LIPZ_UNMEASURED: u32 = 0xC000;

/// A babble profile of a bank. Look it up once; queries go by `index` and `bank`.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct Babble {
    /// Its name: `default` for that of the project.
    pub name: String,
    /// Its place among the profiles, or `LIPZ_BUILT_IN`.
    pub index: u32,
    /// Tells the bank that the profile is of apart from others.
    pub bank: u32,
}

/// What moves the mouth while somebody babbles.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct Weights {
    /// How far the lips are pursed, in ten-thousandths.
    pub ooh: u32,
    /// How far the jaw is open, in ten-thousandths.
    pub aah: u32,
}

/// The babble profile with this name.
#[no_mangle]
pub unsafe extern "C" fn lipz_babble_by_name(
    bank: Option<&Bank>,
    name: *const c_char,
    name_length_bytes: usize,
    babble: Option<&mut MaybeUninit<Babble>>,
) -> Status {
    answer(babble, || {
        // SAFETY: the contract of the crate, which the caller keeps.
        let (bank, name) = unsafe { (opened(bank)?, text(name, name_length_bytes)?) };
        named(&bank, name).ok_or(LIPZ_NONE)
    })
}

/// The profile of the project, `[babble]` in its settings; the viewer's own if it has none.
#[no_mangle]
pub unsafe extern "C" fn lipz_babble_default(bank: Option<&Bank>, babble: Option<&mut MaybeUninit<Babble>>) -> Status {
    answer(babble, || {
        // SAFETY: the contract of the crate, which the caller keeps.
        let bank = unsafe { opened(bank) }?;
        let built_in = || Babble {
            name: String::from_text(lipz_bank::Babble::DEFAULT.name()),
            index: LIPZ_BUILT_IN,
            bank: origin(&bank),
        };
        Ok(named(&bank, "default").unwrap_or_else(built_in))
    })
}

fn named(bank: &lipz_bank::Bank<'_>, name: &str) -> Option<Babble> {
    let (index, found) = (0..).zip(bank.babbles()).find(|(_, babble)| babble.name() == name)?;
    Some(Babble { name: String::from_text(found.name()), index, bank: origin(bank) })
}

/// How lips and jaw are moved `elapsed_us` microseconds after somebody has begun to speak, at a `power` of the voice from
/// 0 to 1. Nobody speaks before 0. `LIPZ_NONE` for a profile of another bank.
#[no_mangle]
pub unsafe extern "C" fn lipz_babble_at_us(
    bank: Option<&Bank>,
    babble: Option<&Babble>,
    elapsed_us: i64,
    power: f32,
    weights: Option<&mut MaybeUninit<Weights>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { babbled(bank, babble, Micros(elapsed_us), power, weights) }
}

/// `lipz_babble_at_us` without floating point: `level` is the power in 65,536ths, at most 65,535, or `LIPZ_UNMEASURED`.
#[no_mangle]
pub unsafe extern "C" fn lipz_babble_at_us_level(
    bank: Option<&Bank>,
    babble: Option<&Babble>,
    elapsed_us: i64,
    level: u32,
    weights: Option<&mut MaybeUninit<Weights>>,
) -> Status {
    let level = VoiceLevel(u16::try_from(level).unwrap_or(u16::MAX));
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { babbled(bank, babble, Micros(elapsed_us), level, weights) }
}

/// How lips and jaw are moved after `position` samples at `rate_hz`.
#[no_mangle]
pub unsafe extern "C" fn lipz_babble_at_samples(
    bank: Option<&Bank>,
    babble: Option<&Babble>,
    position: i64,
    rate_hz: u32,
    power: f32,
    weights: Option<&mut MaybeUninit<Weights>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { babbled(bank, babble, Samples { position, rate_hz }, power, weights) }
}

/// How lips and jaw are moved after `seconds`, with the rule of `lipz_frame_at_seconds`.
#[no_mangle]
pub unsafe extern "C" fn lipz_babble_at_seconds(
    bank: Option<&Bank>,
    babble: Option<&Babble>,
    seconds: f64,
    power: f32,
    weights: Option<&mut MaybeUninit<Weights>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { babbled(bank, babble, Seconds(seconds), power, weights) }
}

/// `lipz_babble_at_seconds` for clocks that have no `double`.
#[no_mangle]
pub unsafe extern "C" fn lipz_babble_at_seconds_f32(
    bank: Option<&Bank>,
    babble: Option<&Babble>,
    seconds: f32,
    power: f32,
    weights: Option<&mut MaybeUninit<Weights>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { babbled(bank, babble, Seconds(seconds), power, weights) }
}

/// What the profile says of this time.
///
/// # Safety
/// The contract of the crate.
unsafe fn babbled(
    bank: Option<&Bank>,
    babble: Option<&Babble>,
    elapsed: impl Time,
    power: impl Power,
    out: Option<&mut MaybeUninit<Weights>>,
) -> Status {
    answer(out, || {
        // SAFETY: the same contract.
        let bank = unsafe { opened(bank) }?;
        let babble = babble.ok_or(LIPZ_NULL_POINTER)?;
        let profile = match babble.index {
            LIPZ_BUILT_IN => Some(lipz_bank::Babble::DEFAULT),
            index => bank.babbles().nth(index as usize).filter(|_| babble.bank == origin(&bank)),
        };
        let weights = profile.ok_or(LIPZ_NONE)?.at(elapsed, power);
        Ok(Weights { ooh: weights.ooh.ten_thousandths().into(), aah: weights.aah.ten_thousandths().into() })
    })
}

/// How far the mouth of a shape is open, in ten-thousandths; `LIPZ_NONE` if `viseme_type` is not one of the three.
#[no_mangle]
pub extern "C" fn lipz_viseme_openness(
    viseme: Viseme,
    viseme_type: u32,
    ten_thousandths: Option<&mut MaybeUninit<u32>>,
) -> Status {
    answer(ten_thousandths, || {
        let kind = u8::try_from(viseme_type).ok().and_then(VisemeType::from_number).ok_or(LIPZ_NONE)?;
        Ok(lipz_bank::Viseme::from_code(viseme.0).openness(kind).ten_thousandths().into())
    })
}

/// One frame of the clip as `lead_us` of a cursor. `LIPZ_NONE` without a frame rate, here and below.
#[no_mangle]
pub unsafe extern "C" fn lipz_lead_one_frame(clip: Option<&Clip>, lead_us: Option<&mut MaybeUninit<u32>>) -> Status {
    answer(lead_us, || Ok(Lead::one_frame(fps(clip)?).us()))
}

/// Two frames of the clip as `lead_us` of a cursor.
#[no_mangle]
pub unsafe extern "C" fn lipz_lead_two_frames(clip: Option<&Clip>, lead_us: Option<&mut MaybeUninit<u32>>) -> Status {
    answer(lead_us, || Ok(Lead::two_frames(fps(clip)?).us()))
}

/// `hold_frames` of a cursor that lets consonants be read: two frames at 24 fps.
#[no_mangle]
pub unsafe extern "C" fn lipz_hold_readable(clip: Option<&Clip>, hold_frames: Option<&mut MaybeUninit<u32>>) -> Status {
    answer(hold_frames, || Ok(ConsonantHold::readable(fps(clip)?).frame_count().into()))
}

/// `hold_frames` of a cursor as long as a display shows one picture: every consonant that has the room is on at least one.
#[no_mangle]
pub unsafe extern "C" fn lipz_hold_for_display(
    clip: Option<&Clip>,
    picture_us: u32,
    hold_frames: Option<&mut MaybeUninit<u32>>,
) -> Status {
    answer(hold_frames, || Ok(ConsonantHold::for_display(picture_us, fps(clip)?).frame_count().into()))
}

fn fps(clip: Option<&Clip>) -> Result<Fps, Status> {
    let clip = clip.ok_or(LIPZ_NULL_POINTER)?;
    Fps::new(clip.fps_numerator, clip.fps_denominator).ok_or(LIPZ_NONE)
}
