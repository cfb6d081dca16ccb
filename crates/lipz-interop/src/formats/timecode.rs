//! Timecodes of Live Link Face recordings, and the frame rate that they imply.

use crate::Time;
use lipz_file::rate::Rate;

/// The usual recording rates.
const RATES: [u32; 4] = [24, 25, 30, 60];
const SECONDS_OF_A_DAY: u64 = 24 * 60 * 60;
/// The parts of a frame. Timecodes have three digits of them.
const PARTS: u32 = 1000;
/// The digits of milliseconds.
const MILLISECOND_DIGITS: usize = 3;

/// A timecode `HH:MM:SS:FF.PPP`, with frames and thousandths of a frame. Some converters write `HH:MM:SS:mmm`, with
/// milliseconds in the place of frames.
#[derive(Clone, Copy)]
pub(super) struct Timecode {
    seconds: u64,
    frame: u32,
    part: u32,
    /// Whether the last field may be milliseconds: three digits without a fraction.
    is_like_milliseconds: bool,
}

impl Timecode {
    pub(super) fn parse(text: &str) -> Option<Timecode> {
        let parts: Vec<&str> = text.split([':', ';']).collect();
        let &[hours, minutes, seconds, frames] = parts.as_slice() else { return None };
        let (frame, part) = frames.split_once('.').unwrap_or((frames, "0"));
        let number = |digits: &str| digits.parse::<u32>().ok().filter(|number| *number < 1000);
        let part = number(format!("{part:0<3}").get(..3)?)?;
        let seconds = (u64::from(number(hours)?) * 60 + u64::from(number(minutes)?)) * 60 + u64::from(number(seconds)?);
        let is_like_milliseconds = frames.len() == MILLISECOND_DIGITS && !frames.contains('.');
        Some(Timecode { seconds, frame: number(frame)?, part, is_like_milliseconds })
    }
}

/// The timecodes of a recording, and the unit of their last field.
pub(super) struct Timecodes {
    /// One for each frame of the file; `None` for a field that is not a timecode.
    pub(super) all: Vec<Option<Timecode>>,
    /// The frame rate of the recording.
    pub(super) rate: Rate,
    /// Whether the last field counts milliseconds.
    pub(super) has_milliseconds: bool,
}

impl Timecodes {
    /// Returns timecodes with the rate that the user names, or with that of the recording.
    pub(super) fn new(all: Vec<Option<Timecode>>, rate: Option<Rate>) -> Timecodes {
        let is_above = |code: &Timecode| rate.is_none_or(|rate| u64::from(code.frame) >= rounded_up(rate));
        let fastest = RATES.into_iter().max().unwrap_or(60);
        // No camera has so many frames.
        let has_milliseconds = all.iter().flatten().all(|code| code.is_like_milliseconds)
            && all.iter().flatten().any(|code| code.frame >= fastest && is_above(code));
        let rate = rate.unwrap_or_else(|| exact(if has_milliseconds { by_steps(&all) } else { by_frames(&all) }));
        Timecodes { all, rate, has_milliseconds }
    }

    /// Whether the rate has the frame of a timecode.
    pub(super) fn has_frame(&self, code: Timecode) -> bool {
        self.has_milliseconds || u64::from(code.frame) < rounded_up(self.rate)
    }

    /// Returns the time of a timecode since `origin`, which may be on the previous day.
    pub(super) fn time_since(&self, code: Timecode, origin: Timecode) -> Time {
        let per_second = match self.has_milliseconds {
            true => 1000,
            false => u64::from(self.rate.numerator) * u64::from(PARTS) / u64::from(self.rate.denominator.max(1)),
        };
        let units = |code: Timecode, days: u64| {
            let seconds = (code.seconds + days * SECONDS_OF_A_DAY) * per_second;
            match self.has_milliseconds {
                true => seconds + u64::from(code.frame),
                false => seconds + u64::from(code.frame) * u64::from(PARTS) + u64::from(code.part),
            }
        };
        let passed = units(code, 0).checked_sub(units(origin, 0));
        let passed = passed.unwrap_or_else(|| units(code, 1).saturating_sub(units(origin, 0)));
        Time::new(passed, u32::try_from(per_second).unwrap_or(u32::MAX))
    }
}

fn exact(rate: u32) -> Rate {
    Rate { numerator: rate, denominator: 1, is_exact: true }
}

/// Returns the number of frame numbers in a second.
fn rounded_up(rate: Rate) -> u64 {
    u64::from(rate.numerator.div_ceil(rate.denominator.max(1)))
}

/// Returns the rate of timecodes with frames: the first one above all their frames, if they count through whole seconds.
fn by_frames(codes: &[Option<Timecode>]) -> u32 {
    let highest = codes.iter().flatten().map(|code| code.frame).max().unwrap_or(0);
    let above = RATES.into_iter().find(|rate| *rate > highest && codes.len() > *rate as usize);
    above.or(RATES.into_iter().max()).unwrap_or(60)
}

/// Returns the rate of timecodes with milliseconds: the one nearest to their usual step.
fn by_steps(codes: &[Option<Timecode>]) -> u32 {
    let ms: Vec<u64> = codes.iter().flatten().map(|code| code.seconds * 1000 + u64::from(code.frame)).collect();
    let mut steps: Vec<u64> = ms.windows(2).filter_map(|pair| pair.get(1)?.checked_sub(*pair.first()?)).collect();
    steps.sort_unstable();
    // Steps are rounded to whole milliseconds, so the sum of those around the median is more exact.
    let around = steps.get(steps.len() / 4..steps.len() - steps.len() / 4).unwrap_or_default();
    let (sum, count) = (around.iter().sum::<u64>(), around.len() as u64);
    let distance = |rate: &u32| (sum * u64::from(*rate)).abs_diff(count * 1000) / u64::from(*rate);
    RATES.into_iter().min_by_key(distance).unwrap_or(60)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    fn code(text: &str) -> Timecode {
        Timecode::parse(text).unwrap()
    }

    #[test]
    fn timecodes_of_recordings() {
        let since = |one, other, fps| {
            let codes = Timecodes::new(vec![Some(code(other)), Some(code(one))], Some(exact(fps)));
            codes.time_since(code(one), code(other)).in_units(1000)
        };
        assert_eq!(since("14:48:33:00.000", "14:48:32:30.000", 60), 500);
        assert_eq!(since("14:48:32:12.500", "14:48:32:12", 30), 17);
        assert_eq!(since("00:00:00:00", "23:59:59:00.0", 60), 1000, "midnight");
        for text in ["", "1:2:3", "a:b:c:d", "1:2:3:4:5", "1:2:3:-4"] {
            assert!(Timecode::parse(text).is_none(), "{text}");
        }
        let through = |highest: u32| {
            by_frames(&(0..90).map(|frame| Some(code(&format!("0:0:0:{}", frame % (highest + 1))))).collect::<Vec<_>>())
        };
        assert_eq!([23, 24, 29, 59].map(through), [24, 25, 30, 60]);
        assert_eq!(by_frames(&[Some(code("0:0:0:1"))]), 60, "too short to tell");
    }

    #[test]
    fn milliseconds_in_the_place_of_frames() {
        for rate in RATES {
            for is_rounded in [false, true] {
                let of = |frame: u32| {
                    let ms = (frame * 1000 + if is_rounded { rate / 2 } else { 0 }) / rate;
                    Some(code(&format!("0:0:{}:{:03}", ms / 1000, ms % 1000)))
                };
                let codes = Timecodes::new((0..90).map(of).collect(), None);
                assert_eq!((codes.has_milliseconds, codes.rate.numerator), (true, rate));
                let last = codes.time_since(codes.all[89].unwrap(), codes.all[0].unwrap());
                assert_eq!(last.nearest_frame(codes.rate), 89);
            }
        }
        let codes = Timecodes::new(vec![Some(code("0:0:0:00")), Some(code("0:0:0:75"))], None);
        assert!(!codes.has_milliseconds && !codes.has_frame(code("0:0:0:75")));
        let named = Timecodes::new(vec![Some(code("0:0:0:000")), Some(code("0:0:0:119"))], Some(exact(120)));
        assert!(!named.has_milliseconds && named.has_frame(code("0:0:0:119")));
    }
}
