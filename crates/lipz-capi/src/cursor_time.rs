//! Moving a cursor, in the units that audio engines report.
//!
//! On with `lipz_cursor_advance_…`, once per picture; from the end to the start with `lipz_cursor_loop_…`, once per round;
//! anywhere else with `lipz_cursor_seek_…`, after which nothing is due.

use crate::bank::Bank;
use crate::cursor::{Cursor, Move, moved};
use crate::status::Status;
use lipz_bank::{Micros, Samples, Seconds};

/// The sound has reached `time_us` microseconds: the events of the segments that have begun since are due. A time before
/// that of the last call makes nothing due, and nothing comes again until the sound is past the point that it had
/// reached: clocks jitter.
#[no_mangle]
pub unsafe extern "C" fn lipz_cursor_advance_us(
    bank: Option<&Bank>,
    cursor: Option<&mut Cursor>,
    time_us: i64,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe {
        moved(bank, cursor, Move::On, |cursor, clip| {
            let _ = cursor.advance_to(clip, Micros(time_us));
        })
    }
}

/// The sound has reached `position` samples (per channel) at `rate_hz` samples per second.
#[no_mangle]
pub unsafe extern "C" fn lipz_cursor_advance_samples(
    bank: Option<&Bank>,
    cursor: Option<&mut Cursor>,
    position: i64,
    rate_hz: u32,
) -> Status {
    let time = Samples { position, rate_hz };
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe {
        moved(bank, cursor, Move::On, |cursor, clip| {
            let _ = cursor.advance_to(clip, time);
        })
    }
}

/// The sound has reached `seconds`, with the rule of `lipz_frame_at_seconds`.
#[no_mangle]
pub unsafe extern "C" fn lipz_cursor_advance_seconds(
    bank: Option<&Bank>,
    cursor: Option<&mut Cursor>,
    seconds: f64,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe {
        moved(bank, cursor, Move::On, |cursor, clip| {
            let _ = cursor.advance_to(clip, Seconds(seconds));
        })
    }
}

/// `lipz_cursor_advance_seconds` for clocks that have no `double`.
#[no_mangle]
pub unsafe extern "C" fn lipz_cursor_advance_seconds_f32(
    bank: Option<&Bank>,
    cursor: Option<&mut Cursor>,
    seconds: f32,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe {
        moved(bank, cursor, Move::On, |cursor, clip| {
            let _ = cursor.advance_to(clip, Seconds(seconds));
        })
    }
}

/// The sound has jumped from its end to its start, and has reached `time_us` microseconds since: what was left is due, then
/// what has begun since. What characters feel, stare and point at outlasts the end of a round.
#[no_mangle]
pub unsafe extern "C" fn lipz_cursor_loop_us(bank: Option<&Bank>, cursor: Option<&mut Cursor>, time_us: i64) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe {
        moved(bank, cursor, Move::Around, |cursor, clip| {
            let _ = cursor.loop_to(clip, Micros(time_us));
        })
    }
}

/// The sound has jumped from its end to its start, and has reached `position` samples since.
#[no_mangle]
pub unsafe extern "C" fn lipz_cursor_loop_samples(
    bank: Option<&Bank>,
    cursor: Option<&mut Cursor>,
    position: i64,
    rate_hz: u32,
) -> Status {
    let time = Samples { position, rate_hz };
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe {
        moved(bank, cursor, Move::Around, |cursor, clip| {
            let _ = cursor.loop_to(clip, time);
        })
    }
}

/// The sound has jumped from its end to its start, and has reached `seconds` since.
#[no_mangle]
pub unsafe extern "C" fn lipz_cursor_loop_seconds(
    bank: Option<&Bank>,
    cursor: Option<&mut Cursor>,
    seconds: f64,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe {
        moved(bank, cursor, Move::Around, |cursor, clip| {
            let _ = cursor.loop_to(clip, Seconds(seconds));
        })
    }
}

/// `lipz_cursor_loop_seconds` for clocks that have no `double`.
#[no_mangle]
pub unsafe extern "C" fn lipz_cursor_loop_seconds_f32(
    bank: Option<&Bank>,
    cursor: Option<&mut Cursor>,
    seconds: f32,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe {
        moved(bank, cursor, Move::Around, |cursor, clip| {
            let _ = cursor.loop_to(clip, Seconds(seconds));
        })
    }
}

/// Jumps to `time_us` microseconds, forward or back. Nothing is due; the next advance starts with the segments that begin
/// in the frame of this time. States are as if the clip had been played once from its start to here.
#[no_mangle]
pub unsafe extern "C" fn lipz_cursor_seek_us(bank: Option<&Bank>, cursor: Option<&mut Cursor>, time_us: i64) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { moved(bank, cursor, Move::Away, |cursor, clip| cursor.seek(clip, Micros(time_us))) }
}

/// Jumps to `position` samples at `rate_hz`.
#[no_mangle]
pub unsafe extern "C" fn lipz_cursor_seek_samples(
    bank: Option<&Bank>,
    cursor: Option<&mut Cursor>,
    position: i64,
    rate_hz: u32,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { moved(bank, cursor, Move::Away, |cursor, clip| cursor.seek(clip, Samples { position, rate_hz })) }
}

/// Jumps to `seconds`, with the rule of `lipz_frame_at_seconds`.
#[no_mangle]
pub unsafe extern "C" fn lipz_cursor_seek_seconds(
    bank: Option<&Bank>,
    cursor: Option<&mut Cursor>,
    seconds: f64,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { moved(bank, cursor, Move::Away, |cursor, clip| cursor.seek(clip, Seconds(seconds))) }
}

/// `lipz_cursor_seek_seconds` for clocks that have no `double`.
#[no_mangle]
pub unsafe extern "C" fn lipz_cursor_seek_seconds_f32(
    bank: Option<&Bank>,
    cursor: Option<&mut Cursor>,
    seconds: f32,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { moved(bank, cursor, Move::Away, |cursor, clip| cursor.seek(clip, Seconds(seconds))) }
}
