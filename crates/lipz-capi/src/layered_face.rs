//! Faces of a stack.

use crate::bank::{Bank, opened};
use crate::clip::of_clip;
use crate::face::{Face, FaceProfile, LookAt, direction, from_found, of_reader};
use crate::layers::{LayeredClip, bank_at, info};
use crate::status::Status;
use crate::who::{self, Who};
use core::mem::MaybeUninit;
use lipz_bank::{Micros, Samples, Seconds, Time};

/// The face of a clip of a stack `time_us` microseconds after the audio began, as `lipz_clip_face_at_us`. `profile` is of
/// `banks[faces_layer]` of `lipz_layers_info`, or null for that of the project. `LIPZ_NONE` for a profile of another bank.
#[no_mangle]
pub unsafe extern "C" fn lipz_layers_face_at_us(
    banks: *const Bank,
    count: u32,
    clip: Option<&LayeredClip>,
    profile: Option<&FaceProfile>,
    look_at: Option<&LookAt>,
    time_us: i64,
    face: Option<&mut MaybeUninit<Face>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { face_of((banks, count), clip, None, profile, look_at, Micros(time_us), face) }
}

/// The face of a clip of a stack after `position` samples at `rate_hz`.
#[no_mangle]
pub unsafe extern "C" fn lipz_layers_face_at_samples(
    banks: *const Bank,
    count: u32,
    clip: Option<&LayeredClip>,
    profile: Option<&FaceProfile>,
    look_at: Option<&LookAt>,
    position: i64,
    rate_hz: u32,
    face: Option<&mut MaybeUninit<Face>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { face_of((banks, count), clip, None, profile, look_at, Samples { position, rate_hz }, face) }
}

/// The face of a clip of a stack after `seconds`.
#[no_mangle]
pub unsafe extern "C" fn lipz_layers_face_at_seconds(
    banks: *const Bank,
    count: u32,
    clip: Option<&LayeredClip>,
    profile: Option<&FaceProfile>,
    look_at: Option<&LookAt>,
    seconds: f64,
    face: Option<&mut MaybeUninit<Face>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { face_of((banks, count), clip, None, profile, look_at, Seconds(seconds), face) }
}

/// `lipz_layers_face_at_seconds` for clocks that have no `double`.
#[no_mangle]
pub unsafe extern "C" fn lipz_layers_face_at_seconds_f32(
    banks: *const Bank,
    count: u32,
    clip: Option<&LayeredClip>,
    profile: Option<&FaceProfile>,
    look_at: Option<&LookAt>,
    seconds: f32,
    face: Option<&mut MaybeUninit<Face>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { face_of((banks, count), clip, None, profile, look_at, Seconds(seconds), face) }
}

/// The face of a character of a clip of a stack `time_us` microseconds after the audio began, as `lipz_clip_face_of_us`, with a
/// profile as for `lipz_layers_face_at_us`.
#[no_mangle]
pub unsafe extern "C" fn lipz_layers_face_of_us(
    banks: *const Bank,
    count: u32,
    clip: Option<&LayeredClip>,
    who: Option<&Who>,
    profile: Option<&FaceProfile>,
    look_at: Option<&LookAt>,
    time_us: i64,
    face: Option<&mut MaybeUninit<Face>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { face_of((banks, count), clip, who, profile, look_at, Micros(time_us), face) }
}

/// The face of a character of a clip of a stack after `position` samples at `rate_hz`.
#[no_mangle]
pub unsafe extern "C" fn lipz_layers_face_of_samples(
    banks: *const Bank,
    count: u32,
    clip: Option<&LayeredClip>,
    who: Option<&Who>,
    profile: Option<&FaceProfile>,
    look_at: Option<&LookAt>,
    position: i64,
    rate_hz: u32,
    face: Option<&mut MaybeUninit<Face>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { face_of((banks, count), clip, who, profile, look_at, Samples { position, rate_hz }, face) }
}

/// The face of a character of a clip of a stack after `seconds`.
#[no_mangle]
pub unsafe extern "C" fn lipz_layers_face_of_seconds(
    banks: *const Bank,
    count: u32,
    clip: Option<&LayeredClip>,
    who: Option<&Who>,
    profile: Option<&FaceProfile>,
    look_at: Option<&LookAt>,
    seconds: f64,
    face: Option<&mut MaybeUninit<Face>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { face_of((banks, count), clip, who, profile, look_at, Seconds(seconds), face) }
}

/// `lipz_layers_face_of_seconds` for clocks that have no `double`.
#[no_mangle]
pub unsafe extern "C" fn lipz_layers_face_of_seconds_f32(
    banks: *const Bank,
    count: u32,
    clip: Option<&LayeredClip>,
    who: Option<&Who>,
    profile: Option<&FaceProfile>,
    look_at: Option<&LookAt>,
    seconds: f32,
    face: Option<&mut MaybeUninit<Face>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { face_of((banks, count), clip, who, profile, look_at, Seconds(seconds), face) }
}

/// # Safety
/// The contract of the crate.
unsafe fn face_of(
    (banks, count): (*const Bank, u32),
    clip: Option<&LayeredClip>,
    who: Option<&Who>,
    profile: Option<&FaceProfile>,
    look_at: Option<&LookAt>,
    time: impl Time,
    out: Option<&mut MaybeUninit<Face>>,
) -> Status {
    let layer = clip.map(|clip| clip.layer).filter(|layer| *layer < count);
    // SAFETY: the same contract.
    unsafe {
        let bank = layer.and_then(|layer| bank_at(banks, layer));
        of_clip(bank, clip.map(|clip| &clip.clip), out, |clip| {
            let with_profiles = opened(bank_at(banks, info(banks, count)?.faces_layer))?;
            let profile = of_reader(&with_profiles, profile)?;
            Ok(from_found(&clip.face_of(who::of_reader(who)?, time, &profile, direction(look_at))))
        })
    }
}
