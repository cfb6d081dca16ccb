//! Reduces samples of every frame to keys.

use lipz_types::CurveValue;

/// Returns few keys for the values at the starts of all frames. The lines between them are at most `tolerance`
/// thousandths from any value. Reads each value once.
pub fn sampled(samples: &[CurveValue], tolerance: i32) -> Vec<(u32, CurveValue)> {
    let Some(first) = samples.first() else { return Vec::new() };
    let mut keys = vec![(0, *first)];
    let mut fan = Fan::new(0, *first);
    let mut last = (0, *first);
    for (frame, pair) in (1..).zip(samples.windows(2)) {
        let (before, now) = (pair[0], pair[1]);
        if !fan.has(fan.slope(frame, now, 0)) {
            keys.push((frame - 1, before));
            fan = Fan::new(frame - 1, before);
        }
        fan.narrow(frame, now, tolerance);
        last = (frame, now);
    }
    // A curve keeps its last value.
    if keys[keys.len() - 1].1 != last.1 {
        keys.push(last);
    }
    keys
}

/// The slope of a line: its rise over a number of frames.
#[derive(Clone, Copy)]
struct Slope {
    rise: i64,
    frames: i64,
}

impl Slope {
    fn is_below(self, other: Slope) -> bool {
        self.rise * other.frames < other.rise * self.frames
    }
}

/// The lines from a key that pass near all samples since then.
struct Fan {
    start: (u32, CurveValue),
    lowest: Option<Slope>,
    highest: Option<Slope>,
}

impl Fan {
    fn new(frame: u32, value: CurveValue) -> Fan {
        Fan { start: (frame, value), lowest: None, highest: None }
    }

    /// Returns the slope of the line to a value, raised by `above` thousandths.
    fn slope(&self, frame: u32, value: CurveValue, above: i32) -> Slope {
        let rise = i64::from(value.thousandths()) + i64::from(above) - i64::from(self.start.1.thousandths());
        Slope { rise, frames: i64::from(frame - self.start.0) }
    }

    fn has(&self, slope: Slope) -> bool {
        !self.lowest.is_some_and(|lowest| slope.is_below(lowest))
            && !self.highest.is_some_and(|highest| highest.is_below(slope))
    }

    fn narrow(&mut self, frame: u32, value: CurveValue, tolerance: i32) {
        let (low, high) = (self.slope(frame, value, -tolerance), self.slope(frame, value, tolerance));
        self.lowest = Some(self.lowest.filter(|lowest| low.is_below(*lowest)).unwrap_or(low));
        self.highest = Some(self.highest.filter(|highest| highest.is_below(high)).unwrap_or(high));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn samples(thousandths: &[i32]) -> Vec<CurveValue> {
        thousandths.iter().map(|value| CurveValue::from_thousandths(*value)).collect()
    }

    #[test]
    fn straight_lines_need_no_keys_between() {
        let keys = |values: &[i32]| {
            let keys = sampled(&samples(values), 0);
            keys.into_iter().map(|(frame, value)| (frame, value.thousandths())).collect::<Vec<_>>()
        };
        assert_eq!(keys(&[7, 7, 7]), [(0, 7)]);
        assert_eq!(keys(&[0, 0, 0, 500, 1000, 1000, 0]), [(0, 0), (2, 0), (4, 1000), (5, 1000), (6, 0)]);
        assert_eq!(keys(&[0, 1, 2, 1]), [(0, 0), (2, 2), (3, 1)]);
        assert_eq!(keys(&[3]), [(0, 3)]);
    }

    proptest! {
        #[test]
        fn no_sample_is_farther_from_the_lines_than_allowed(
            values in proptest::collection::vec(-9000..9000, 1..200),
            tolerance in 0..900,
        ) {
            let keys = sampled(&samples(&values), tolerance);
            prop_assert!(keys.windows(2).all(|pair| pair[0].0 < pair[1].0));
            for (frame, sample) in (0..).zip(&values) {
                let next = keys.partition_point(|(key, _)| *key <= frame);
                let (key, value) = keys[next - 1];
                let line = match keys.get(next) {
                    None => f64::from(value.thousandths()),
                    Some((end, to)) => {
                        let way = f64::from(frame - key) / f64::from(end - key);
                        f64::from(value.thousandths()) * (1.0 - way) + f64::from(to.thousandths()) * way
                    }
                };
                prop_assert!((line - f64::from(*sample)).abs() <= f64::from(tolerance) + 1e-6, "{frame}: {line} {sample}");
            }
        }
    }
}
