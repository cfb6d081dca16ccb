//! Detection of clipping, where a recording exceeds the range of its samples.

/// Samples at or above this are at full scale, from which it is half a step of 8 bits away.
const FULL_SCALE: f32 = 0.996;
/// The least number of them in a row that counts as clipping. An unclipped peak touches full scale once or twice.
const LEAST_RUN: usize = 3;
/// Places closer together than this, in microseconds, are merged: half a second.
const NEAR_US: u64 = 500_000;
/// The most places that are stored. The last stands for all after it.
const MOST_PLACES: usize = 100;

/// A place where a recording is clipped at full scale.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Clipping {
    /// The start in microseconds, from the start of the audio.
    pub start_us: u64,
    /// The end in microseconds.
    pub end_us: u64,
}

/// Finds clipped samples.
#[derive(Clone, Debug, Default)]
pub(super) struct ClippingFinder {
    /// By channel: the number of consecutive samples at full scale.
    runs: Vec<usize>,
    pub(super) places: Vec<Clipping>,
}

impl ClippingFinder {
    /// Processes samples of all channels. The first is sample number `first`, at `rate_hz` samples per second.
    pub(super) fn push(&mut self, interleaved: &[f32], channels: usize, first: u64, rate_hz: u32) {
        self.runs.resize(channels, 0);
        for (frame, number) in interleaved.chunks_exact(channels).zip(first..) {
            for (run, sample) in self.runs.iter_mut().zip(frame) {
                *run = if sample.abs() >= FULL_SCALE { *run + 1 } else { 0 };
                if *run >= LEAST_RUN {
                    let time_us = |number: u64| number * 1_000_000 / u64::from(rate_hz);
                    add(&mut self.places, time_us(number.saturating_sub(*run as u64 - 1)), time_us(number + 1));
                }
            }
        }
    }
}

fn add(places: &mut Vec<Clipping>, start_us: u64, end_us: u64) {
    let is_full = places.len() >= MOST_PLACES;
    match places.last_mut() {
        Some(last) if is_full || start_us <= last.end_us + NEAR_US => last.end_us = last.end_us.max(end_us),
        _ => places.push(Clipping { start_us, end_us }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn places(interleaved: &[f32], channels: usize) -> Vec<Clipping> {
        let mut finder = ClippingFinder::default();
        for (number, block) in interleaved.chunks(2 * channels).enumerate() {
            finder.push(block, channels, number as u64 * 2, 1_000);
        }
        finder.places
    }

    #[test]
    fn flat_tops_are_found_and_peaks_are_not() {
        let mut samples = vec![0.0; 2_000];
        samples[10..12].fill(1.0);
        assert_eq!(places(&samples, 1), []);
        samples[100..104].fill(1.0);
        samples[200..203].fill(-1.0);
        samples[1_500..1_510].fill(0.999);
        let found = [(100_000, 203_000), (1_500_000, 1_510_000)];
        assert_eq!(places(&samples, 1), found.map(|(start_us, end_us)| Clipping { start_us, end_us }));
    }

    #[test]
    fn channels_are_counted_apart() {
        assert_eq!(places(&[1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0], 2), []);
        assert_eq!(places(&[0.0, 1.0, 0.0, 1.0, 0.0, 1.0], 2).len(), 1);
    }

    #[test]
    fn a_square_wave_of_an_hour_is_few_places() {
        let mut finder = ClippingFinder::default();
        for second in 0..1_000 {
            finder.push(&[1.0; 3], 1, second * 1_000, 1_000);
        }
        assert_eq!(finder.places.len(), MOST_PLACES);
        assert_eq!(finder.places[MOST_PLACES - 1].end_us, 999_003_000);
    }
}
