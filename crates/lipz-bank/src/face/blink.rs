//! Blinks: single ones, sometimes two in a row.

use super::chance::{Steps, Stream, draw, part};
use super::{Emotion, FaceProfile};
use crate::curve::CurveValue;

/// How far closed lids are closed, in thousandths.
const CLOSED: u64 = 1000;

/// Returns how far the lids are closed, in thousandths. `strongest` is the leading emotion at a time.
///
/// Each interval has its own grid with one blink in each slot. A blink counts if its interval is that of the leading
/// emotion when the blink begins.
pub(super) fn closed(
    profile: &FaceProfile<'_>,
    Steps { seed, ms }: Steps,
    strongest: impl Fn(u64) -> Option<(Emotion, CurveValue)>,
) -> i32 {
    let intervals = profile.blink_intervals();
    let mut most = 0;
    for (place, interval) in intervals.iter().enumerate() {
        let is_first = intervals.get(..place).map_or(true, |before| !before.contains(interval));
        if *interval == 0 || !is_first {
            continue;
        }
        let interval = u64::from(*interval);
        // Slots begin before the start of the clip, so that its first blink can come at any time.
        let phase = u64::from(part(interval as u32, draw(seed, Stream::BlinkPhase, interval, 0)));
        let slot = ms.wrapping_add(phase).checked_div(interval).unwrap_or(0);
        for slot in [slot.wrapping_sub(1), slot] {
            // In the middle half of the slot.
            let late = part((interval / 2) as u32, draw(seed, Stream::BlinkTime, interval, slot));
            let start = slot.wrapping_mul(interval).wrapping_add(interval / 4).wrapping_add(u64::from(late));
            let passed = match (start.checked_sub(phase), ms.wrapping_add(phase).checked_sub(start)) {
                (Some(start), Some(passed)) => (start, passed),
                _ => continue, // before the clip, or in the future
            };
            let is_double =
                part(100, draw(seed, Stream::DoubleBlink, interval, slot)) < u32::from(profile.double_blink_percent());
            let closed = closed_after(passed.1, profile.blink_length_ms(), is_double);
            if closed > most
                && u64::from(profile.blink_interval_ms(strongest(passed.0).map(|(leads, _)| leads))) == interval
            {
                most = closed;
            }
        }
    }
    most as i32
}

/// Returns how far the lids are closed `passed_ms` after the start of a blink. They close in a quarter of its length,
/// stay closed for a quarter, and open in the rest. The second blink of a double one begins half a length after the
/// first.
fn closed_after(passed_ms: u64, length_ms: u16, is_double: bool) -> u64 {
    let length = u64::from(length_ms);
    let again = length.wrapping_add(length / 2);
    let passed = if is_double && passed_ms >= again { passed_ms.wrapping_sub(again) } else { passed_ms };
    let (closing, open_from) = (length / 4, length / 2);
    if passed < closing {
        passed.wrapping_mul(CLOSED).checked_div(closing).unwrap_or(CLOSED)
    } else if passed < open_from {
        CLOSED
    } else {
        let left = length.saturating_sub(passed).wrapping_mul(CLOSED);
        left.checked_div(length.wrapping_sub(open_from)).unwrap_or(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::vec::Vec;

    #[test]
    fn a_blink_closes_fast_and_opens_slowly() {
        let shape = |is_double, times: &[u64]| -> Vec<u64> {
            times.iter().map(|ms| closed_after(*ms, 240, is_double)).collect()
        };
        assert_eq!(shape(false, &[0, 30, 60, 119, 120, 180, 239, 240, 400]), [0, 500, 1000, 1000, 1000, 500, 8, 0, 0]);
        assert_eq!(shape(true, &[240, 359, 390, 420, 540, 600, 700]), [0, 0, 500, 1000, 500, 0, 0]);
    }
}
