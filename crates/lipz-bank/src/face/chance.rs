//! Random numbers that are the same on every machine: draws from a hash, and steps from one draw to the next.

use lipz_types::hash::{FINISH, STEP, mix};

/// The purpose of a draw: draws with different purposes are independent.
#[derive(Clone, Copy)]
#[repr(u8)]
pub(super) enum Stream {
    BlinkPhase = 1,
    BlinkTime = 2,
    DoubleBlink = 3,
    PoseTime = 4,
    Pitch = 5,
    Yaw = 6,
    Roll = 7,
    FixationTime = 8,
    Glance = 9,
    Target = 10,
    EyePitch = 11,
    EyeYaw = 12,
}

/// Returns a uniformly distributed number from 0 to 65,535. `interval` distinguishes the draws of different grids of
/// blinks.
#[cfg_attr(not(target_pointer_width = "64"), inline(never))]
pub(super) fn draw(seed: u64, stream: Stream, interval: u64, index: u64) -> u32 {
    let stream = interval << 8 | stream as u64;
    (mix(mix(mix(seed ^ stream, STEP) ^ index, FINISH), STEP) >> 48) as u32
}

/// Maps a draw to a number from 0 up to, but not including, `amount`.
pub(super) fn part(amount: u32, draw: u32) -> u32 {
    (u64::from(amount).wrapping_mul(u64::from(draw)) >> 16) as u32
}

/// Maps a draw to a number from -`amount` up to, but not including, `amount`.
pub(super) fn either_side(amount: u32, draw: u32) -> i32 {
    (part(amount.wrapping_mul(2), draw) as i32).wrapping_sub(amount as i32)
}

/// Returns `value` · `part` / `whole`, rounded towards 0; 0 if `whole` is 0.
#[cfg_attr(not(target_pointer_width = "64"), inline(never))]
pub(super) fn scaled(value: i32, part: u64, whole: u64) -> i32 {
    let product = i64::from(value).wrapping_mul(part as i64);
    product.checked_div(whole as i64).unwrap_or(0) as i32
}

/// The value of [`ChanceStep::part`] for a finished step.
pub(super) const WHOLE: u64 = 1 << 16;

/// The state of a value that changes at random times.
pub(super) struct ChanceStep {
    pub(super) before: u64,
    pub(super) now: u64,
    /// How far it has moved from `before` to `now`, in 65,536ths.
    pub(super) part: u64,
}

/// A seed and a time to draw steps for.
#[derive(Clone, Copy)]
pub(super) struct Steps {
    pub(super) seed: u64,
    pub(super) ms: u64,
}

impl Steps {
    /// Returns the current step. There is one step in each `period_ms`. It starts in the first half of it and takes
    /// `step_ms`, at most half a period.
    pub(super) fn step(self, stream: Stream, period_ms: u16, step_ms: u16) -> ChanceStep {
        let period = u64::from(period_ms);
        let number = self.ms.checked_div(period).unwrap_or(0);
        let start = |number: u64| {
            let late = part(u32::from(period_ms / 2), draw(self.seed, stream, 0, number));
            number.wrapping_mul(period).wrapping_add(u64::from(late))
        };
        // The state before the first step has the number 0, so each step leads to its own number plus one.
        let begun = if self.ms >= start(number) { Some(number) } else { number.checked_sub(1) };
        let number = match begun {
            Some(number) => number,
            None => return ChanceStep { before: 0, now: 0, part: WHOLE },
        };
        let (passed, whole) = (self.ms.saturating_sub(start(number)), u64::from(step_ms));
        let part = if passed < whole { (passed << 16).checked_div(whole).unwrap_or(WHOLE) } else { WHOLE };
        ChanceStep { before: number, now: number.wrapping_add(1), part }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn draws_are_even_and_independent() {
        const COUNT: u64 = 1 << 16;
        let streams = [Stream::BlinkTime, Stream::Glance];
        for seed in [0, 1, 0xE6CA_2504_98E9_94B1] {
            let mut buckets = [0_u32; 16];
            let mut alike = 0_u32;
            for index in 0..COUNT {
                let [first, second] = streams.map(|stream| draw(seed, stream, 0, index) >> 12);
                buckets[first as usize] += 1;
                alike += u32::from(first == second) + u32::from(first == draw(seed, streams[0], 0, index + 1) >> 12);
            }
            // Each bucket expects 4,096, and half of them 8,192: five standard deviations are 310 and 440.
            assert!(buckets.iter().all(|count| count.abs_diff(4096) < 310), "{buckets:?}");
            assert!(alike.abs_diff(8192) < 440, "{alike}");
        }
    }

    /// docs/guides/faces.md has the same numbers, for other implementations.
    #[test]
    fn draws_of_the_page() {
        let draws = [(0, 0), (0, 1), (1, 0)].map(|(seed, index)| draw(seed, Stream::PoseTime, 0, index));
        assert_eq!(draws, [3057, 6476, 8253]);
        assert_eq!(draw(0xE6CA_2504_98E9_94B1, Stream::BlinkTime, 4000, 3), 2656);
        assert_eq!((part(1000, 0xFFFF), either_side(1000, 0), either_side(1000, 0xFFFF)), (999, -1000, 999));
        assert_eq!((scaled(-7, 1, 2), scaled(7, 1, 2), scaled(7, 1, 0)), (-3, 3, 0));
    }
}
