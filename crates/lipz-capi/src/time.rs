//! Times, in the units that audio engines report.

use lipz_bank::{Micros, Samples, Seconds};

/// The `rate_hz` of a time in seconds.
pub const LIPZ_SECONDS: u32 = 0xFFFF_FFFF;
/// The `rate_hz` of a time in seconds that comes from a clock without `double`.
pub const LIPZ_SECONDS_F32: u32 = 0xFFFF_FFFE;

/// A time since the audio began, as `lipz_time_us`, `lipz_time_samples`, `lipz_time_seconds` and `lipz_time_seconds_f32` make it.
///
/// Each unit leads to the frame of exact arithmetic. Times before the start, from the end on, infinite or not a number lead to no
/// frame, and so to rest.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Time {
    /// Microseconds, or samples per channel.
    pub count: i64,
    /// Seconds.
    pub seconds: f64,
    /// 0 for microseconds, `LIPZ_SECONDS`, `LIPZ_SECONDS_F32`, or samples per second.
    pub rate_hz: u32,
    /// 0.
    pub reserved: u32,
}

/// Calls a method with a time, in its unit.
macro_rules! at {
    ($time:expr, |$each:ident| $call:expr) => {
        match $time.rate_hz {
            0 => {
                let $each = $crate::time::micros(&$time);
                $call
            }
            $crate::time::LIPZ_SECONDS => {
                let $each = $crate::time::seconds(&$time);
                $call
            }
            $crate::time::LIPZ_SECONDS_F32 => {
                let $each = $crate::time::seconds_f32(&$time);
                $call
            }
            _ => {
                let $each = $crate::time::samples(&$time);
                $call
            }
        }
    };
}

pub(crate) fn micros(time: &Time) -> Micros {
    Micros(time.count)
}

pub(crate) fn samples(time: &Time) -> Samples {
    Samples { position: time.count, rate_hz: time.rate_hz }
}

pub(crate) fn seconds(time: &Time) -> Seconds<f64> {
    Seconds(time.seconds)
}

#[allow(clippy::cast_possible_truncation)] // it was an `f32`
pub(crate) fn seconds_f32(time: &Time) -> Seconds<f32> {
    Seconds(time.seconds as f32)
}
