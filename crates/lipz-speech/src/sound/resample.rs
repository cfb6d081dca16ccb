//! Resampling to the rate of the acoustic model, block by block.
//!
//! A windowed sinc, as in J. O. Smith, "Digital Audio Resampling": each output sample is the sum of the input around
//! its time, weighted by a sinc with a Kaiser window. It must produce the same bits on every machine. The crate rubato
//! does not: it chooses among instruction sets at run time, and their sums round differently.

use std::f64::consts::PI;

/// The number of zeros of the sinc on each side.
const ZEROS: usize = 16;
/// The passband's share of half the lower rate; the rest is the filter's slope.
const PASSBAND: f64 = 0.94;
/// The window's shape: side lobes below -80 dB (Kaiser 1974).
const BETA: f64 = 8.0;
/// The most phases of the filter in the table. Rates without a small common ratio use the nearest phase.
const MOST_PHASES: u32 = 512;

/// A resampler of one channel.
pub(crate) struct Resampler {
    from_hz: u64,
    to_hz: u64,
    /// Coefficients by phase: `2 * reach` for each.
    table: Vec<f32>,
    phases: u64,
    reach: usize,
    /// The input that is still needed: the samples from `start` on, in input time. It starts with silence.
    pending: Vec<f32>,
    start: i64,
    /// The number of input samples and of output samples.
    input: u64,
    output: u64,
}

impl Resampler {
    /// Returns a resampler from `from_hz` to `to_hz` samples per second. Neither may be 0.
    pub(crate) fn new(from_hz: u32, to_hz: u32) -> Resampler {
        let ratio = f64::from(to_hz) / f64::from(from_hz);
        // Below half of the lower rate.
        let cutoff = PASSBAND * ratio.min(1.0);
        #[expect(clippy::cast_possible_truncation, reason = "16 to a few thousand")]
        let reach = (ZEROS_F64 / cutoff).ceil() as usize;
        let phases = (to_hz / gcd(from_hz, to_hz)).min(MOST_PHASES);
        let mut table = Vec::new();
        for phase in 0..phases {
            table.extend(filter(f64::from(phase) / f64::from(phases), cutoff, reach));
        }
        Resampler {
            from_hz: from_hz.into(),
            to_hz: to_hz.into(),
            table,
            phases: phases.into(),
            reach,
            pending: vec![0.0; reach],
            start: -i64::try_from(reach).unwrap_or(0),
            input: 0,
            output: 0,
        }
    }

    /// Processes `samples`, and appends all output that they determine to `out`.
    pub(crate) fn push(&mut self, samples: &[f32], out: &mut Vec<f32>) {
        self.input += samples.len() as u64;
        if self.from_hz == self.to_hz {
            out.extend_from_slice(samples);
            return;
        }
        self.pending.extend_from_slice(samples);
        self.run(self.input, out);
    }

    /// Appends the rest of the output, as if silence followed.
    pub(crate) fn finish(mut self, out: &mut Vec<f32>) {
        if self.from_hz != self.to_hz {
            let end = self.input * self.to_hz / self.from_hz;
            self.pending.resize(self.pending.len() + 2 * self.reach, 0.0);
            self.run(self.input + 2 * self.reach as u64, out);
            let excess = usize::try_from(self.output.saturating_sub(end)).unwrap_or(0);
            out.truncate(out.len().saturating_sub(excess));
        }
    }

    /// Computes the output for the input before `input`.
    fn run(&mut self, input: u64, out: &mut Vec<f32>) {
        loop {
            // The output's time in input samples, exactly: an integer and a phase.
            let time = self.output * self.from_hz;
            let mut whole = time / self.to_hz;
            let mut phase = (time % self.to_hz * self.phases + self.to_hz / 2) / self.to_hz;
            if phase == self.phases {
                (whole, phase) = (whole + 1, 0);
            }
            if whole + self.reach as u64 >= input {
                break;
            }
            // The filter's window: `reach` samples up to the time, `reach` after it.
            let first = whole.cast_signed() - self.reach as i64 + 1 - self.start;
            let first = usize::try_from(first).unwrap_or(0);
            let window = self.pending.get(first..first + 2 * self.reach).unwrap_or(&[]);
            let from = usize::try_from(phase).unwrap_or(0) * 2 * self.reach;
            let coefficients = self.table.get(from..from + 2 * self.reach).unwrap_or(&[]);
            out.push(dot(window, coefficients));
            self.output += 1;
        }
        // Drop samples that no later output needs.
        let needed = (self.output * self.from_hz / self.to_hz).cast_signed() - self.reach as i64;
        let unneeded = usize::try_from(needed - self.start).unwrap_or(0).min(self.pending.len());
        self.pending.drain(..unneeded);
        self.start += unneeded as i64;
    }
}

const ZEROS_F64: f64 = ZEROS as f64;

/// Returns the sum of products, added in an order that suits vector code.
fn dot(a: &[f32], b: &[f32]) -> f32 {
    let mut sums = [0.0_f32; 8];
    let (a_chunks, b_chunks) = (a.chunks_exact(8), b.chunks_exact(8));
    let rest: f32 = a_chunks.remainder().iter().zip(b_chunks.remainder()).map(|(x, y)| x * y).sum();
    for (x, y) in a_chunks.zip(b_chunks) {
        for lane in 0..8 {
            sums[lane] += x[lane] * y[lane];
        }
    }
    sums.iter().sum::<f32>() + rest
}

/// Returns the coefficients for an output sample `phase` (0 to 1) after an input sample. Their sum is 1.
fn filter(phase: f64, cutoff: f64, reach: usize) -> Vec<f32> {
    let weights: Vec<f64> = (0..2 * reach)
        .map(|tap| {
            let distance = tap as f64 - (reach as f64 - 1.0) - phase;
            let edge = distance / reach as f64;
            sinc(distance * cutoff) * kaiser(edge)
        })
        .collect();
    let sum: f64 = weights.iter().sum();
    #[expect(clippy::cast_possible_truncation, reason = "coefficients are single")]
    weights.iter().map(|weight| (weight / sum) as f32).collect()
}

fn sinc(x: f64) -> f64 {
    if x.abs() < 1e-9 { 1.0 } else { libm::sin(PI * x) / (PI * x) }
}

/// Returns the Kaiser window, which is 1 in the middle and near 0 at -1 and 1.
fn kaiser(x: f64) -> f64 {
    if x.abs() >= 1.0 {
        return 0.0;
    }
    bessel(BETA * libm::sqrt(1.0 - x * x)) / bessel(BETA)
}

/// Returns the modified Bessel function of the first kind, of order zero, from its series.
fn bessel(x: f64) -> f64 {
    let mut term = 1.0;
    let mut sum = 1.0;
    for k in 1..40 {
        let factor = x / (2.0 * f64::from(k));
        term *= factor * factor;
        sum += term;
    }
    sum
}

fn gcd(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { gcd(b, a % b) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tone(rate_hz: u32, tone_hz: usize, samples: usize) -> Vec<f32> {
        let turns = |i: usize| (i * tone_hz % rate_hz as usize) as f32 / rate_hz as f32;
        (0..samples).map(|i| (std::f32::consts::TAU * turns(i)).sin()).collect()
    }

    fn resampled(from_hz: u32, input: &[f32], block: usize) -> Vec<f32> {
        let mut resampler = Resampler::new(from_hz, 16_000);
        let mut out = Vec::new();
        for block in input.chunks(block) {
            resampler.push(block, &mut out);
        }
        resampler.finish(&mut out);
        out
    }

    #[test]
    fn a_tone_stays_a_tone_at_every_rate() {
        for rate_hz in [8_000, 11_025, 16_000, 22_050, 32_000, 44_100, 47_999, 48_000, 96_000] {
            let out = resampled(rate_hz, &tone(rate_hz, 1_000, rate_hz as usize / 2), 1000);
            assert_eq!(out.len(), rate_hz as usize / 2 * 16_000 / rate_hz as usize, "{rate_hz}");
            let expected = tone(16_000, 1_000, out.len());
            let worst = |range: std::ops::Range<usize>| range.map(|i| (out[i] - expected[i]).abs()).fold(0.0, f32::max);
            assert!(worst(500..7_500) < 0.01, "{rate_hz}: {}", worst(500..7_500));
        }
    }

    #[test]
    fn what_16_khz_cannot_hold_is_gone() {
        let out = resampled(48_000, &tone(48_000, 10_000, 48_000), 512);
        assert!(out[500..15_500].iter().all(|sample| sample.abs() < 0.002));
    }

    #[test]
    fn blocks_make_no_difference() {
        let input = tone(44_100, 440, 5_000);
        let whole = resampled(44_100, &input, 5_000);
        for block in [1, 7, 160, 4_999] {
            assert_eq!(resampled(44_100, &input, block), whole, "{block}");
        }
        assert!(resampled(44_100, &[], 1).is_empty());
        assert!(resampled(44_100, &[0.5], 1).is_empty());
    }
}
