//! Missing parts of a recording.

/// The missing parts in the middle of a recording: their number and total length.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Damage {
    /// The number of places. Adjacent ones count once.
    pub places: u64,
    /// The start of the first place in microseconds, from the start of the audio.
    pub start_us: u64,
    /// The total length of the missing parts in microseconds, as far as it can be determined. They are filled with
    /// silence.
    pub missing_us: u64,
    /// The end of the last place.
    end_us: u64,
}

impl Damage {
    /// Adds a place, given by its first and last sample.
    pub(super) fn add(&mut self, start: u64, end: u64, rate_hz: u32) {
        let time_us = |sample: u64| sample * 1_000_000 / u64::from(rate_hz);
        let (start_us, end_us) = (time_us(start), time_us(end));
        if self.places == 0 {
            self.start_us = start_us;
        }
        if self.places == 0 || start_us > self.end_us {
            self.places += 1;
        }
        self.missing_us += end_us - start_us;
        self.end_us = end_us;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_side_by_side_are_one() {
        let mut damage = Damage::default();
        for (start, end) in [(8_000, 8_100), (8_100, 8_200), (9_000, 9_000), (16_000, 24_000)] {
            damage.add(start, end, 16_000);
        }
        assert_eq!((damage.places, damage.start_us, damage.missing_us), (3, 500_000, 512_500));
    }
}
