//! Curves of a clip: named numbers that change while it plays, such as blend shapes and emotions.
//!
//! Values are in thousandths. Between two keys they change linearly; before the first key and after the last they are
//! constant.

use crate::clip::{Clip, given, of_clip};
use crate::dialogue::{Dialogue, reader};
use crate::pointer::{answer, text};
use crate::status::{LIPZ_NONE, LIPZ_NULL_POINTER, Status};
use crate::string::{String, c_char};
use crate::time::Time;
use core::mem::MaybeUninit;
use lipz_bank::Fps;
use lipz_bank::curve::CurveValue;

/// A curve of a clip, in the version of the dialogue in which it was found. The fields are read-only.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct Curve {
    /// Its name: `jawOpen`, `anger`.
    pub name: String,
    /// Number of keys, at least 1 in a verified bank.
    pub key_count: u32,
    /// The version of the dialogue. In a different version, queries of the curve return `LIPZ_NONE`.
    pub version: u32,
    /// The number of its file.
    pub file: u32,
    /// The number of its clip in that file.
    pub slot: u32,
    /// Its index among all curves of that file.
    pub place: u32,
    /// Frames of its clip per `fps_denominator` seconds.
    pub fps_numerator: u32,
    /// Seconds in which `fps_numerator` frames pass.
    pub fps_denominator: u32,
    /// 0.
    pub reserved: u32,
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

/// The last key of a curve that was used. Start with zeros: `lipz_curve_cursor cursor = {0}`.
///
/// With it, no search for keys is needed while the time advances by a few keys per rendered frame. The values are
/// always the same, even after a jump or with a cursor of another curve.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct CurveCursor {
    /// The index of the key.
    pub key: u32,
}

fn from_reader(version: u32, clip: &lipz_bank::Clip<'_>, curve: &lipz_bank::curve::Curve<'_>) -> Curve {
    Curve {
        name: String::from_text(curve.name().as_str()),
        key_count: curve.key_count(),
        version,
        file: clip.file(),
        slot: clip.slot(),
        place: curve.place(),
        fps_numerator: clip.fps().map_or(0, Fps::numerator),
        fps_denominator: clip.fps().map_or(0, Fps::denominator),
        reserved: 0,
    }
}

/// Writes the curve of a clip with this name. `LIPZ_NONE` if it has none.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_curve(
    dialogue: Option<&Dialogue>,
    clip: Option<&Clip>,
    name: *const c_char,
    name_length_bytes: usize,
    curve: Option<&mut MaybeUninit<Curve>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe {
        of_clip(dialogue, clip, curve, |dialogue, clip| {
            let found = clip.curve(text(name, name_length_bytes)?).ok_or(LIPZ_NONE)?;
            Ok(from_reader(dialogue.version(), &clip, &found))
        })
    }
}

/// Writes the curve of a clip with this index, ordered by name. Call it from 0 on until `LIPZ_NONE`.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_curve_by_index(
    dialogue: Option<&Dialogue>,
    clip: Option<&Clip>,
    index: u32,
    curve: Option<&mut MaybeUninit<Curve>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe {
        of_clip(dialogue, clip, curve, |dialogue, clip| {
            let found = clip.curves().nth(index as usize).ok_or(LIPZ_NONE)?;
            Ok(from_reader(dialogue.version(), &clip, &found))
        })
    }
}

/// Writes the key of a curve with this index, a number below its `key_count`.
#[no_mangle]
pub unsafe extern "C" fn lipz_curve_key(
    dialogue: Option<&Dialogue>,
    curve: Option<&Curve>,
    index: u32,
    key: Option<&mut MaybeUninit<CurveKey>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe {
        of_curve(dialogue, curve, key, |curve| {
            let key = curve.key(index).ok_or(LIPZ_NONE)?;
            Ok(CurveKey { frame: key.frame, thousandths: key.value.thousandths() })
        })
    }
}

/// Writes the value of a curve at the start of a frame, in thousandths.
#[no_mangle]
pub unsafe extern "C" fn lipz_curve_value(
    dialogue: Option<&Dialogue>,
    curve: Option<&Curve>,
    frame: u32,
    thousandths: Option<&mut MaybeUninit<i32>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { of_curve(dialogue, curve, thousandths, |curve| Ok(curve.value(frame).thousandths())) }
}

/// Writes the value of a curve at a time, in thousandths. `LIPZ_NONE` without a frame rate. `cursor` may be null; with
/// one, a rendered frame needs no search for keys.
#[no_mangle]
pub unsafe extern "C" fn lipz_curve_value_at(
    dialogue: Option<&Dialogue>,
    curve: Option<&Curve>,
    time: Time,
    cursor: Option<&mut CurveCursor>,
    thousandths: Option<&mut MaybeUninit<i32>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe {
        of_curve(dialogue, curve, thousandths, |curve| {
            let mut inner = lipz_bank::curve::CurveCursor::from_word(cursor.as_ref().map_or(0, |cursor| cursor.key));
            let value = inner.value_at(&curve, time.to_reader());
            if let Some(cursor) = cursor {
                cursor.key = inner.to_word();
            }
            value.map(CurveValue::thousandths).ok_or(LIPZ_NONE)
        })
    }
}

/// Answers a query about a curve.
///
/// # Safety
/// The contract of the crate.
unsafe fn of_curve<'a, T: Default>(
    dialogue: Option<&'a Dialogue>,
    curve: Option<&Curve>,
    out: Option<&mut MaybeUninit<T>>,
    query: impl FnOnce(lipz_bank::curve::Curve<'a>) -> Result<T, Status>,
) -> Status {
    answer(out, || {
        // SAFETY: the same contract.
        let dialogue = unsafe { reader(dialogue) }?;
        let asked = curve.ok_or(LIPZ_NULL_POINTER)?;
        let clip = if asked.version == dialogue.version() { dialogue.clip_at(asked.file, asked.slot) } else { None };
        let clip = given(clip.ok_or(LIPZ_NONE)?, asked.fps_numerator, asked.fps_denominator, 0);
        query(clip.curve_in_place(asked.place).ok_or(LIPZ_NONE)?)
    })
}
