//! Faces that move by themselves: lids, head and eyes at a time. Angles are in thousandths of a degree: pitch is positive
//! upwards, yaw to the left of the character, roll towards the left shoulder.

use crate::babble::LIPZ_BUILT_IN;
use crate::bank::{Bank, opened, origin};
use crate::clip::{Clip, of_clip};
use crate::pointer::{answer, text};
use crate::status::{LIPZ_NONE, Status};
use crate::string::{String, c_char};
use crate::who::{self, Who};
use core::mem::MaybeUninit;
use lipz_bank::{CurveValue, Micros, Samples, Seconds, Time};

/// A face profile of a bank. Look it up once; queries go by `index` and `bank`.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct FaceProfile {
    /// Its name: `default` for that of the project.
    pub name: String,
    /// Its place among the profiles, or `LIPZ_BUILT_IN`.
    pub index: u32,
    /// Tells the bank that the profile is of apart from others.
    pub bank: u32,
}

/// What somebody looks at: a direction, as seen from the head at rest.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct LookAt {
    /// How far up it is.
    pub pitch: i32,
    /// How far to the left of the character it is.
    pub yaw: i32,
    /// 1 for a person, over whose face, hands and body the eyes go; 0 for something that they stay on.
    pub is_person: u32,
}

/// What a face does at a time, besides its mouth and its emotions. Numbers are in thousandths.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct Face {
    /// How far the lids are closed: 0 to 1,000.
    pub blink: i32,
    /// How far the head is raised.
    pub head_pitch: i32,
    /// How far the head is turned.
    pub head_yaw: i32,
    /// How far the head is tilted.
    pub head_roll: i32,
    /// How far the eyes are raised in the head.
    pub eye_pitch: i32,
    /// How far the eyes are turned in the head.
    pub eye_yaw: i32,
    /// How far the brows are raised: 0 to 1,000. Only curves raise them.
    pub brows: i32,
    /// A shrug of the face, 0 to 1,000. Only curves make one.
    pub shrug: i32,
    /// How hard somebody breathes: 0 to 10,000. Only curves say so.
    pub breath: i32,
}

/// The face profile with this name.
#[no_mangle]
pub unsafe extern "C" fn lipz_face_profile_by_name(
    bank: Option<&Bank>,
    name: *const c_char,
    name_length_bytes: usize,
    profile: Option<&mut MaybeUninit<FaceProfile>>,
) -> Status {
    answer(profile, || {
        // SAFETY: the contract of the crate, which the caller keeps.
        let (bank, name) = unsafe { (opened(bank)?, text(name, name_length_bytes)?) };
        named(&bank, name).ok_or(LIPZ_NONE)
    })
}

/// The profile of the project, `[face]` in its settings; the usual one if it has none.
#[no_mangle]
pub unsafe extern "C" fn lipz_face_profile_default(
    bank: Option<&Bank>,
    profile: Option<&mut MaybeUninit<FaceProfile>>,
) -> Status {
    answer(profile, || {
        // SAFETY: the contract of the crate, which the caller keeps.
        let bank = unsafe { opened(bank) }?;
        let built_in = || FaceProfile {
            name: String::from_text(lipz_bank::FaceProfile::DEFAULT.name()),
            index: LIPZ_BUILT_IN,
            bank: origin(&bank),
        };
        Ok(named(&bank, "default").unwrap_or_else(built_in))
    })
}

fn named(bank: &lipz_bank::Bank<'_>, name: &str) -> Option<FaceProfile> {
    let (index, found) = (0..).zip(bank.face_profiles()).find(|(_, profile)| profile.name() == name)?;
    Some(FaceProfile { name: String::from_text(found.name()), index, bank: origin(bank) })
}

/// The speaker's face `time_us` microseconds after the audio began, generated as `profile` says. Curves of the clip win over
/// what is generated. `profile` may be null for that of the project, `look_at` for somebody straight ahead. `LIPZ_NONE` for a
/// profile of another bank.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_face_at_us(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    profile: Option<&FaceProfile>,
    look_at: Option<&LookAt>,
    time_us: i64,
    face: Option<&mut MaybeUninit<Face>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { face_of(bank, clip, None, profile, look_at, Micros(time_us), face) }
}

/// The speaker's face after `position` samples at `rate_hz`.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_face_at_samples(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    profile: Option<&FaceProfile>,
    look_at: Option<&LookAt>,
    position: i64,
    rate_hz: u32,
    face: Option<&mut MaybeUninit<Face>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { face_of(bank, clip, None, profile, look_at, Samples { position, rate_hz }, face) }
}

/// The speaker's face after `seconds`.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_face_at_seconds(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    profile: Option<&FaceProfile>,
    look_at: Option<&LookAt>,
    seconds: f64,
    face: Option<&mut MaybeUninit<Face>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { face_of(bank, clip, None, profile, look_at, Seconds(seconds), face) }
}

/// `lipz_clip_face_at_seconds` for clocks that have no `double`.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_face_at_seconds_f32(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    profile: Option<&FaceProfile>,
    look_at: Option<&LookAt>,
    seconds: f32,
    face: Option<&mut MaybeUninit<Face>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { face_of(bank, clip, None, profile, look_at, Seconds(seconds), face) }
}

/// The face of a character of the clip `time_us` microseconds after the audio began: with the curves that have the name in
/// front, and blinks by their own emotions. The head of somebody who listens moves for these curves and for what is looked at only. `who`
/// may be null for the speaker, the others as for `lipz_clip_face_at_us`.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_face_of_us(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    who: Option<&Who>,
    profile: Option<&FaceProfile>,
    look_at: Option<&LookAt>,
    time_us: i64,
    face: Option<&mut MaybeUninit<Face>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { face_of(bank, clip, who, profile, look_at, Micros(time_us), face) }
}

/// The face of a character of the clip after `position` samples at `rate_hz`.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_face_of_samples(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    who: Option<&Who>,
    profile: Option<&FaceProfile>,
    look_at: Option<&LookAt>,
    position: i64,
    rate_hz: u32,
    face: Option<&mut MaybeUninit<Face>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { face_of(bank, clip, who, profile, look_at, Samples { position, rate_hz }, face) }
}

/// The face of a character of the clip after `seconds`.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_face_of_seconds(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    who: Option<&Who>,
    profile: Option<&FaceProfile>,
    look_at: Option<&LookAt>,
    seconds: f64,
    face: Option<&mut MaybeUninit<Face>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { face_of(bank, clip, who, profile, look_at, Seconds(seconds), face) }
}

/// `lipz_clip_face_of_seconds` for clocks that have no `double`.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_face_of_seconds_f32(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    who: Option<&Who>,
    profile: Option<&FaceProfile>,
    look_at: Option<&LookAt>,
    seconds: f32,
    face: Option<&mut MaybeUninit<Face>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { face_of(bank, clip, who, profile, look_at, Seconds(seconds), face) }
}

/// The face of somebody who says nothing, `time_us` microseconds from anywhere: they blink and look. `seed` tells them apart
/// from others, so that not everybody blinks at once.
#[no_mangle]
pub unsafe extern "C" fn lipz_face_idle_at_us(
    bank: Option<&Bank>,
    profile: Option<&FaceProfile>,
    look_at: Option<&LookAt>,
    seed: u64,
    time_us: i64,
    face: Option<&mut MaybeUninit<Face>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { idle_at(bank, profile, look_at, seed, Micros(time_us), face) }
}

/// The face of somebody who says nothing, after `position` samples at `rate_hz`.
#[no_mangle]
pub unsafe extern "C" fn lipz_face_idle_at_samples(
    bank: Option<&Bank>,
    profile: Option<&FaceProfile>,
    look_at: Option<&LookAt>,
    seed: u64,
    position: i64,
    rate_hz: u32,
    face: Option<&mut MaybeUninit<Face>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { idle_at(bank, profile, look_at, seed, Samples { position, rate_hz }, face) }
}

/// The face of somebody who says nothing, after `seconds`.
#[no_mangle]
pub unsafe extern "C" fn lipz_face_idle_at_seconds(
    bank: Option<&Bank>,
    profile: Option<&FaceProfile>,
    look_at: Option<&LookAt>,
    seed: u64,
    seconds: f64,
    face: Option<&mut MaybeUninit<Face>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { idle_at(bank, profile, look_at, seed, Seconds(seconds), face) }
}

/// `lipz_face_idle_at_seconds` for clocks that have no `double`.
#[no_mangle]
pub unsafe extern "C" fn lipz_face_idle_at_seconds_f32(
    bank: Option<&Bank>,
    profile: Option<&FaceProfile>,
    look_at: Option<&LookAt>,
    seed: u64,
    seconds: f32,
    face: Option<&mut MaybeUninit<Face>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { idle_at(bank, profile, look_at, seed, Seconds(seconds), face) }
}

/// # Safety
/// The contract of the crate.
unsafe fn face_of(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    who: Option<&Who>,
    profile: Option<&FaceProfile>,
    look_at: Option<&LookAt>,
    time: impl Time,
    out: Option<&mut MaybeUninit<Face>>,
) -> Status {
    // SAFETY: the same contract.
    unsafe {
        of_clip(bank, clip, out, |clip| {
            let opened = opened(bank)?;
            Ok(from_found(&clip.face_of(who::of_reader(who)?, time, &of_reader(&opened, profile)?, direction(look_at))))
        })
    }
}

/// # Safety
/// The contract of the crate.
unsafe fn idle_at(
    bank: Option<&Bank>,
    profile: Option<&FaceProfile>,
    look_at: Option<&LookAt>,
    seed: u64,
    time: impl Time,
    out: Option<&mut MaybeUninit<Face>>,
) -> Status {
    answer(out, || {
        // SAFETY: the same contract.
        let bank = unsafe { opened(bank) }?;
        Ok(from_found(&of_reader(&bank, profile)?.idle_at(time, seed, direction(look_at))))
    })
}

/// The profile that the caller means.
pub(crate) fn of_reader<'data>(
    bank: &lipz_bank::Bank<'data>,
    profile: Option<&FaceProfile>,
) -> Result<lipz_bank::FaceProfile<'data>, Status> {
    match profile {
        None => Ok(bank.default_face_profile()),
        Some(FaceProfile { index: LIPZ_BUILT_IN, .. }) => Ok(lipz_bank::FaceProfile::DEFAULT),
        Some(asked) => {
            let found = bank.face_profiles().nth(asked.index as usize);
            found.filter(|_| asked.bank == origin(bank)).ok_or(LIPZ_NONE)
        }
    }
}

pub(crate) fn direction(look_at: Option<&LookAt>) -> lipz_bank::LookAt {
    let value = CurveValue::from_thousandths;
    match look_at {
        None => lipz_bank::LookAt::AHEAD,
        Some(LookAt { pitch, yaw, is_person: 0 }) => lipz_bank::LookAt::point(value(*pitch), value(*yaw)),
        Some(LookAt { pitch, yaw, .. }) => lipz_bank::LookAt::person(value(*pitch), value(*yaw)),
    }
}

pub(crate) fn from_found(face: &lipz_bank::Face) -> Face {
    Face {
        blink: face.blink.thousandths(),
        head_pitch: face.head_pitch.thousandths(),
        head_yaw: face.head_yaw.thousandths(),
        head_roll: face.head_roll.thousandths(),
        eye_pitch: face.eye_pitch.thousandths(),
        eye_yaw: face.eye_yaw.thousandths(),
        brows: face.brows.thousandths(),
        shrug: face.shrug.thousandths(),
        breath: face.breath.thousandths(),
    }
}
