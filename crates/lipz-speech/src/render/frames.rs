//! Exact conversion between frames and times.

use lipz_types::Fps;

const SECOND_US: u128 = 1_000_000;

/// Returns the number of frames that a duration takes, rounded up.
pub(super) fn count(duration_us: u64, fps: Fps) -> usize {
    let frames = (u128::from(duration_us) * u128::from(fps.numerator())).div_ceil(per_numerator_us(fps));
    usize::try_from(frames).unwrap_or(usize::MAX)
}

/// Returns the middle of a frame, in microseconds, rounded down.
pub(super) fn centre_us(frame: usize, fps: Fps) -> u64 {
    let halves = 2 * frame as u128 + 1;
    u64::try_from(halves * per_numerator_us(fps) / (2 * u128::from(fps.numerator()))).unwrap_or(u64::MAX)
}

/// Returns the first frame whose middle is not before `time_us`.
pub(super) fn first_at(time_us: u64, fps: Fps) -> usize {
    // centre(f) >= time, that is (2 f + 1) d >= 2 n t, with microseconds in d
    let halves = (2 * u128::from(time_us) * u128::from(fps.numerator())).div_ceil(per_numerator_us(fps));
    usize::try_from(halves / 2).unwrap_or(usize::MAX)
}

/// Rounds a time to the nearest number of frames, in microseconds, rounded up so that such a duration contains the
/// middles of that many frames.
pub(super) fn hold_us(time_us: u64, fps: Fps) -> u64 {
    let (numerator, denominator) = (u128::from(fps.numerator()), per_numerator_us(fps));
    let frames = (u128::from(time_us) * numerator + denominator / 2) / denominator;
    u64::try_from((frames.max(1) * denominator).div_ceil(numerator)).unwrap_or(u64::MAX) + 1
}

/// Returns the least time that a shape keeps when others take time from it, if possible: two fifths of a frame, which
/// still often shows.
pub(super) fn least_us(fps: Fps) -> u64 {
    u64::try_from(per_numerator_us(fps) * 2 / 5 / u128::from(fps.numerator())).unwrap_or(u64::MAX)
}

/// Returns the microseconds of as many frames as the numerator of the rate.
fn per_numerator_us(fps: Fps) -> u128 {
    u128::from(fps.denominator()) * SECOND_US
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_and_times_agree_at_every_rate() {
        let rates = [Fps::whole(1), Fps::whole(24), Fps::whole(60), Fps::whole(1000)];
        for fps in rates.into_iter().chain(Fps::new(24_000, 1001)).chain(Fps::new(30_000, 1001)) {
            for frame in [0, 1, 2, 23, 999, 100_000] {
                let centre = centre_us(frame, fps);
                assert_eq!(first_at(centre, fps), frame, "{fps:?}");
                assert_eq!(first_at(centre + 1, fps), frame + 1, "{fps:?}");
                assert!(count(centre, fps) == frame + 1, "{fps:?}");
            }
        }
        assert_eq!(count(0, Fps::whole(24)), 0);
        assert_eq!(count(1_000_000, Fps::whole(24)), 24);
        assert_eq!(count(1_000_001, Fps::whole(24)), 25);
    }

    #[test]
    fn a_hold_is_in_whole_frames() {
        let frames = |fps: u16| hold_us(83_333, Fps::whole(fps)) * u64::from(fps) / 1_000_000;
        assert_eq!([12, 24, 25, 30, 48, 60].map(frames), [1, 2, 2, 2, 4, 5]);
    }
}
