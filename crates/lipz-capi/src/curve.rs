//! Curves of a clip: named numbers that change while it plays, such as blend shapes and emotions.
//!
//! Values are in thousandths. Between two keys they change evenly; outside of the keys they are those of the first and last.

use crate::bank::Bank;
use crate::clip::{Clip, of_clip};
use crate::pointer::text;
use crate::status::{LIPZ_NONE, LIPZ_NULL_POINTER, Status};
use crate::string::{String, c_char};
use core::mem::MaybeUninit;
use lipz_bank::{CurveValue, Micros, Samples, Seconds, Time};

/// A curve of a clip. Queries go by `index`; the other fields are there to be read.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct Curve {
    /// Its name: `jawOpen`, `anger`.
    pub name: String,
    /// Its place among the curves of its clip, which are in the order of their names.
    pub index: u32,
    /// Number of keys, at least 1 in a verified bank.
    pub key_count: u32,
}

/// A key of a curve: its value at the start of a frame.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct CurveKey {
    /// The frame.
    pub frame: u32,
    /// The value in thousandths.
    pub thousandths: i32,
}

fn from_found(index: usize, curve: &lipz_bank::Curve<'_>) -> Curve {
    let name = String::from_text(curve.name().as_str());
    Curve { name, index: u32::try_from(index).unwrap_or(u32::MAX), key_count: curve.key_count() }
}

/// The curve of a clip with this name. `LIPZ_NONE` if it has none.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_curve(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    name: *const c_char,
    name_length_bytes: usize,
    curve: Option<&mut MaybeUninit<Curve>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe {
        of_clip(bank, clip, curve, |clip| {
            let found = clip.curve(text(name, name_length_bytes)?).ok_or(LIPZ_NONE)?;
            let index = clip.curves().take_while(|curve| curve.name() != found.name()).count();
            Ok(from_found(index, &found))
        })
    }
}

/// The curve of a clip with this index: ask from 0 on until `LIPZ_NONE`.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_curve_at(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    index: u32,
    curve: Option<&mut MaybeUninit<Curve>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe {
        of_clip(bank, clip, curve, |clip| {
            let index = index as usize;
            Ok(from_found(index, &clip.curves().nth(index).ok_or(LIPZ_NONE)?))
        })
    }
}

/// The key of a curve with this index, a number below its `key_count`.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_curve_key(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    curve: Option<&Curve>,
    index: u32,
    key: Option<&mut MaybeUninit<CurveKey>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe {
        of_curve(bank, clip, curve, key, |curve| {
            let key = curve.key(index).ok_or(LIPZ_NONE)?;
            Ok(CurveKey { frame: key.frame, thousandths: key.value.thousandths() })
        })
    }
}

/// The value of a curve at the start of a frame, in thousandths.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_curve_value(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    curve: Option<&Curve>,
    frame: u32,
    thousandths: Option<&mut MaybeUninit<i32>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { of_curve(bank, clip, curve, thousandths, |curve| Ok(curve.value(frame).thousandths())) }
}

/// The value of a curve `time_us` microseconds after the audio began, in thousandths. `LIPZ_NONE` without a frame rate.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_curve_value_at_us(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    curve: Option<&Curve>,
    time_us: i64,
    thousandths: Option<&mut MaybeUninit<i32>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { value_at(bank, clip, curve, Micros(time_us), thousandths) }
}

/// The value of a curve after `position` samples at `rate_hz`, in thousandths. `LIPZ_NONE` without a frame rate.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_curve_value_at_samples(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    curve: Option<&Curve>,
    position: i64,
    rate_hz: u32,
    thousandths: Option<&mut MaybeUninit<i32>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { value_at(bank, clip, curve, Samples { position, rate_hz }, thousandths) }
}

/// The value of a curve after `seconds`, in thousandths. `LIPZ_NONE` without a frame rate.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_curve_value_at_seconds(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    curve: Option<&Curve>,
    seconds: f64,
    thousandths: Option<&mut MaybeUninit<i32>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { value_at(bank, clip, curve, Seconds(seconds), thousandths) }
}

/// `lipz_clip_curve_value_at_seconds` for clocks that have no `double`.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_curve_value_at_seconds_f32(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    curve: Option<&Curve>,
    seconds: f32,
    thousandths: Option<&mut MaybeUninit<i32>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { value_at(bank, clip, curve, Seconds(seconds), thousandths) }
}

/// # Safety
/// The contract of the crate.
unsafe fn value_at(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    curve: Option<&Curve>,
    time: impl Time,
    thousandths: Option<&mut MaybeUninit<i32>>,
) -> Status {
    // SAFETY: the same contract.
    unsafe {
        of_curve(bank, clip, curve, thousandths, |curve| {
            curve.value_at(time).map(CurveValue::thousandths).ok_or(LIPZ_NONE)
        })
    }
}

/// Answers a query about a curve: the one of the clip with the index of `curve`.
///
/// # Safety
/// The contract of the crate.
unsafe fn of_curve<T: Default>(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    curve: Option<&Curve>,
    out: Option<&mut MaybeUninit<T>>,
    query: impl FnOnce(lipz_bank::Curve<'_>) -> Result<T, Status>,
) -> Status {
    // SAFETY: the same contract.
    unsafe {
        of_clip(bank, clip, out, |clip| {
            let index = curve.ok_or(LIPZ_NULL_POINTER)?.index as usize;
            query(clip.curves().nth(index).ok_or(LIPZ_NONE)?)
        })
    }
}
