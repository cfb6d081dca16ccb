//! The time of a query, in numbers of 32 bits.

use crate::Time;
use lipz_types::{Fps, Position, StoredFps};

/// The time of a query: whole milliseconds from the start of the clip, and the microseconds after them.
#[derive(Clone, Copy)]
pub(super) struct QueryTime {
    ms: i32,
    us: i32,
}

/// How many milliseconds before its start and after its end a sound can matter: the longest rise.
const REACH_MS: i32 = 150;
/// The most milliseconds from a query to a start or an end. Longer ones are cut, which does not change their effect.
const MOST_MS: i32 = 400;
/// The same in microseconds.
pub(super) const MOST_US: u32 = 400_000;

/// A frame rate with one frame per millisecond, computed by the compiler, because a wrong rate would panic.
const MILLISECONDS: Fps = Fps::whole(1000);

impl QueryTime {
    /// Returns the time, and `lead_ms` more. Times before the start of the clip are out of reach.
    pub(super) fn of<T: Time>(time: T, lead_ms: i16) -> QueryTime {
        if !time.has_begun() {
            return QueryTime { ms: -MOST_MS, us: 0 };
        }
        let Position { frame, sixteen_bits } = time.position(StoredFps::from(MILLISECONDS));
        let ms = frame.min(i32::MAX as u32) as i32;
        QueryTime {
            ms: ms.saturating_add(i32::from(lead_ms)),
            us: (u32::from(sixteen_bits).wrapping_mul(1000) >> 16) as i32,
        }
    }

    /// Returns the microseconds from now until a time in milliseconds, limited to 0.4 s in both directions.
    pub(super) fn until(self, ms: u32) -> i32 {
        let ms = (ms.min(i32::MAX as u32) as i32).saturating_sub(self.ms).clamp(-MOST_MS, MOST_MS);
        ms.wrapping_mul(1000).wrapping_sub(self.us)
    }

    /// Returns the first and the last millisecond in reach.
    pub(super) fn reach(self) -> (u32, u32) {
        let [first, last] = [-REACH_MS, REACH_MS].map(|reach| self.ms.saturating_add(reach).max(0) as u32);
        (first, last)
    }
}
