//! Decoded samples, with silence for missing ones.

use super::decode::{DecodingReport, RATES_HZ};
use super::error::SoundError;
use symphonia::core::audio::GenericAudioBufferRef;

/// The longest silence for a missing part, in seconds, so that a damaged number cannot produce a day of it.
const MOST_SILENCE_S: u64 = 600;
/// The samples of silence that are output at a time.
const BLOCK: usize = 4_096;

/// Passes decoded samples on as one channel.
pub(super) struct Output<T> {
    take: T,
    pub(super) decoded: DecodingReport,
    rate_hz: Option<u32>,
    /// The number of samples that were passed on, and of missing samples before the first, while the rate is unknown.
    given: u64,
    owed: Option<u64>,
    /// The most samples to pass on, if the file states their number.
    most: u64,
    /// Whether the last packet had a different rate.
    is_off: bool,
    interleaved: Vec<f32>,
    mono: Vec<f32>,
}

impl<T: FnMut(u32, &[f32]) -> Result<(), SoundError>> Output<T> {
    pub(super) fn new(take: T, most: Option<u64>) -> Output<T> {
        let (interleaved, mono) = Default::default();
        Output {
            take,
            decoded: DecodingReport::default(),
            rate_hz: None,
            given: 0,
            owed: None,
            most: most.unwrap_or(u64::MAX),
            is_off: false,
            interleaved,
            mono,
        }
    }

    /// Passes on the samples of a packet.
    pub(super) fn push(&mut self, buffer: &GenericAudioBufferRef<'_>) -> Result<(), SoundError> {
        let rate_hz = buffer.spec().rate();
        if !RATES_HZ.contains(&rate_hz) {
            return Err(SoundError::Rate { rate_hz });
        }
        if *self.rate_hz.get_or_insert(rate_hz) != rate_hz {
            // One packet with a different rate is a damaged number, two are a different recording.
            return match std::mem::replace(&mut self.is_off, true) {
                true => Err(SoundError::RateChanges),
                false => self.leave_out(buffer.frames() as u64),
            };
        }
        self.is_off = false;
        if let Some(owed) = self.owed.take() {
            self.leave_out(owed)?;
        }
        let channels = buffer.num_planes().max(1);
        buffer.copy_to_vec_interleaved::<f32>(&mut self.interleaved);
        self.decoded.clipping.push(&self.interleaved, channels, self.given, rate_hz);
        self.mono.clear();
        self.mono.extend(self.interleaved.chunks_exact(channels).map(mean));
        if let Some(louder) = cancelled(&self.interleaved, channels, &self.mono) {
            self.mono.clear();
            let of_channel = self.interleaved.iter().skip(louder).step_by(channels);
            self.mono.extend(of_channel.map(|sample| mean(std::slice::from_ref(sample))));
        }
        self.mono.truncate(usize::try_from(self.most - self.given.min(self.most)).unwrap_or(usize::MAX));
        self.given += self.mono.len() as u64;
        (self.take)(rate_hz, &self.mono)
    }

    /// Inserts silence for so many missing samples; 0 if their number is unknown.
    pub(super) fn leave_out(&mut self, samples: u64) -> Result<(), SoundError> {
        let Some(rate_hz) = self.rate_hz else {
            self.owed = Some(self.owed.unwrap_or(0).saturating_add(samples));
            return Ok(());
        };
        let start = self.given;
        self.be_silent(samples, rate_hz)?;
        self.decoded.damage.add(start, self.given, rate_hz);
        Ok(())
    }

    fn be_silent(&mut self, samples: u64, rate_hz: u32) -> Result<(), SoundError> {
        let left_us = (MOST_SILENCE_S * 1_000_000).saturating_sub(self.decoded.damage.missing_us);
        let mut left = samples.min(left_us * u64::from(rate_hz) / 1_000_000);
        let silence = [0.0; BLOCK];
        while left > 0 {
            let block = silence.get(..usize::try_from(left).unwrap_or(BLOCK)).unwrap_or(&silence);
            (self.take)(rate_hz, block)?;
            self.given += block.len() as u64;
            left -= block.len() as u64;
        }
        Ok(())
    }
}

/// The factor by which the power of a channel is higher than that of the mean if channels cancel each other out: 20
/// decibels. A stereo recording with one inverted channel has nothing in the middle.
const CANCELLED: f32 = 100.0;

/// Returns the loudest channel if the mean of all channels is far below it.
fn cancelled(interleaved: &[f32], channels: usize, mono: &[f32]) -> Option<usize> {
    let power = |samples: &mut dyn Iterator<Item = &f32>| -> f32 {
        samples.filter(|sample| sample.is_finite()).map(|sample| sample * sample).sum()
    };
    let of_channel = |channel: usize| power(&mut interleaved.iter().skip(channel).step_by(channels));
    let loudest = (0..channels).max_by(|one, other| of_channel(*one).total_cmp(&of_channel(*other)))?;
    (channels > 1 && of_channel(loudest) > CANCELLED * power(&mut mono.iter())).then_some(loudest)
}

/// Returns the mean of all channels. Floats in files may be NaN or infinite, which counts as silence.
fn mean(frame: &[f32]) -> f32 {
    let sum: f32 = frame.iter().map(|&sample| if sample.is_finite() { sample.clamp(-1.0, 1.0) } else { 0.0 }).sum();
    let channels = frame.len() as f32;
    sum / channels
}
