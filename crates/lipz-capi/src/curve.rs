//! Curves of a clip: named numbers that change while it plays, such as blend shapes and emotions.
//!
//! Values are in thousandths. Between two keys they change evenly; outside of the keys they are those of the first and last.

use crate::bank::{Bank, origin};
use crate::clip::{Clip, of_clip_in};
use crate::pointer::text;
use crate::status::{LIPZ_NONE, LIPZ_NULL_POINTER, Status};
use crate::string::{String, c_char};
use core::mem::MaybeUninit;
use lipz_bank::{CurveValue, Micros, Samples, Seconds, Time};

/// A curve of a clip. Queries go by `place` and `bank`; the other fields are there to be read.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct Curve {
    /// Its name: `jawOpen`, `anger`.
    pub name: String,
    /// Its place among all curves of the bank.
    pub place: u32,
    /// Number of keys, at least 1 in a verified bank.
    pub key_count: u32,
    /// Tells the bank that the curve is of apart from others: asked of another one, also of a newer version, a curve gives
    /// `LIPZ_NONE`.
    pub bank: u32,
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

/// Which key of a curve was needed last. Start with zeros: `lipz_curve_cursor cursor = {0}`.
///
/// With it, no key is searched for as long as time moves on by a few keys per picture. The answers are the same, also
/// after a jump, and with a cursor of another curve.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct CurveCursor {
    /// The key, by its index.
    pub key: u32,
}

fn from_found(bank: &lipz_bank::Bank<'_>, curve: &lipz_bank::Curve<'_>) -> Curve {
    Curve {
        name: String::from_text(curve.name().as_str()),
        place: curve.place(),
        key_count: curve.key_count(),
        bank: origin(bank),
    }
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
        of_clip_in(bank, clip, curve, |bank, clip| {
            let found = clip.curve(text(name, name_length_bytes)?).ok_or(LIPZ_NONE)?;
            Ok(from_found(bank, &found))
        })
    }
}

/// The curve of a clip with this index, in the order of their names: ask from 0 on until `LIPZ_NONE`.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_curve_at(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    index: u32,
    curve: Option<&mut MaybeUninit<Curve>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe {
        of_clip_in(bank, clip, curve, |bank, clip| {
            let found = clip.curves().nth(index as usize).ok_or(LIPZ_NONE)?;
            Ok(from_found(bank, &found))
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

/// The value of a curve at the start of a frame, in thousandths. `cursor` may be null.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_curve_value(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    curve: Option<&Curve>,
    cursor: Option<&mut CurveCursor>,
    frame: u32,
    thousandths: Option<&mut MaybeUninit<i32>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe {
        of_curve(bank, clip, curve, thousandths, |curve| {
            Ok(with_cursor(cursor, |cursor| cursor.value(&curve, frame)).thousandths())
        })
    }
}

/// The value of a curve `time_us` microseconds after the audio began, in thousandths. `LIPZ_NONE` without a frame rate.
/// `cursor` may be null; with one, a picture needs no search among the keys.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_curve_value_at_us(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    curve: Option<&Curve>,
    cursor: Option<&mut CurveCursor>,
    time_us: i64,
    thousandths: Option<&mut MaybeUninit<i32>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { value_at(bank, clip, curve, cursor, Micros(time_us), thousandths) }
}

/// The value of a curve after `position` samples at `rate_hz`, in thousandths. `LIPZ_NONE` without a frame rate.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_curve_value_at_samples(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    curve: Option<&Curve>,
    cursor: Option<&mut CurveCursor>,
    position: i64,
    rate_hz: u32,
    thousandths: Option<&mut MaybeUninit<i32>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { value_at(bank, clip, curve, cursor, Samples { position, rate_hz }, thousandths) }
}

/// The value of a curve after `seconds`, in thousandths. `LIPZ_NONE` without a frame rate.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_curve_value_at_seconds(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    curve: Option<&Curve>,
    cursor: Option<&mut CurveCursor>,
    seconds: f64,
    thousandths: Option<&mut MaybeUninit<i32>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { value_at(bank, clip, curve, cursor, Seconds(seconds), thousandths) }
}

/// `lipz_clip_curve_value_at_seconds` for clocks that have no `double`.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_curve_value_at_seconds_f32(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    curve: Option<&Curve>,
    cursor: Option<&mut CurveCursor>,
    seconds: f32,
    thousandths: Option<&mut MaybeUninit<i32>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { value_at(bank, clip, curve, cursor, Seconds(seconds), thousandths) }
}

/// # Safety
/// The contract of the crate.
unsafe fn value_at(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    curve: Option<&Curve>,
    cursor: Option<&mut CurveCursor>,
    time: impl Time,
    thousandths: Option<&mut MaybeUninit<i32>>,
) -> Status {
    // SAFETY: the same contract.
    unsafe {
        of_curve(bank, clip, curve, thousandths, |curve| {
            with_cursor(cursor, |cursor| cursor.value_at(&curve, time)).map(CurveValue::thousandths).ok_or(LIPZ_NONE)
        })
    }
}

/// Asks with the cursor of the caller, and writes back where it is; with a new one without it.
fn with_cursor<T>(cursor: Option<&mut CurveCursor>, ask: impl FnOnce(&mut lipz_bank::CurveCursor) -> T) -> T {
    let mut moved = lipz_bank::CurveCursor::from_word(cursor.as_ref().map_or(0, |cursor| cursor.key));
    let answer = ask(&mut moved);
    if let Some(cursor) = cursor {
        cursor.key = moved.to_word();
    }
    answer
}

/// Answers a query about a curve: the one in the place of `curve`, if that is of this bank.
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
        of_clip_in(bank, clip, out, |bank, clip| {
            let asked = curve.ok_or(LIPZ_NULL_POINTER)?;
            let found = if asked.bank == origin(bank) { clip.curve_in_place(asked.place) } else { None };
            query(found.ok_or(LIPZ_NONE)?)
        })
    }
}
