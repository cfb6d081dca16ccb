//! Times, in the units that audio engines report.

use lipz_bank::{AnyTime, Micros, Samples, Seconds};

/// The `rate_hz` of a time in seconds.
pub const LIPZ_SECONDS: u32 = 0xFFFF_FFFF;
/// The `rate_hz` of a time in seconds that comes from a clock without `double`.
pub const LIPZ_SECONDS_F32: u32 = 0xFFFF_FFFE;

/// A time since the audio began. Make it with `lipz_time_us`, `lipz_time_samples`, `lipz_time_seconds` or
/// `lipz_time_seconds_f32`.
///
/// Each unit leads to the same frame as exact arithmetic. Times before the start, from the end on, infinite or NaN lead
/// to no frame, and so to rest.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Time {
    /// Microseconds, samples per channel, or the bits of a `double` or a `float`.
    pub count: i64,
    /// 0 for microseconds, `LIPZ_SECONDS`, `LIPZ_SECONDS_F32`, or samples per second.
    pub rate_hz: u32,
    /// 0.
    pub reserved: u32,
}

impl Time {
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // reinterprets bits
    pub(crate) fn to_reader(self) -> AnyTime {
        match self.rate_hz {
            0 => AnyTime::Micros(Micros(self.count)),
            LIPZ_SECONDS => AnyTime::SecondsF64(Seconds(f64::from_bits(self.count as u64))),
            LIPZ_SECONDS_F32 => AnyTime::SecondsF32(Seconds(f32::from_bits(self.count as u32))),
            rate_hz => AnyTime::Samples(Samples { position: self.count, rate_hz }),
        }
    }
}
