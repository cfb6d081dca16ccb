//! Lip-sync tracks of type `rms`, which follow the loudness of the voice.

use super::{Mouth, frames};
use crate::Sound;
use crate::features::mel::{HOP, RATE_HZ, WINDOW};
use crate::sound::level::{SILENT_DB, decibels, voice_powers};
use lipz_types::Fps;

/// The rules with which [`rms`] converts loudness to visemes.
#[derive(Clone, Copy, PartialEq, Debug)]
#[non_exhaustive]
pub struct RmsRules {
    /// The level below the loud frames of the recording, in decibels, at which the mouth closes. The default is 30,
    /// between voice and room noise.
    pub threshold_db: f32,
    /// A mouth that is closed for this long, in microseconds, rests. The default is 150 milliseconds, as in alignments.
    pub shortest_pause_us: u64,
    /// The exponent of the amplitude: 1 opens the mouth in proportion, less opens it wider for quiet speech. The
    /// default is 0.5.
    pub exponent: f32,
    /// The time by which the mouth precedes the audio, in microseconds. The default is 40 milliseconds, as in
    /// [`super::RenderRules::lead_us`].
    pub lead_us: u64,
}

impl Default for RmsRules {
    fn default() -> RmsRules {
        RmsRules { threshold_db: 30.0, shortest_pause_us: 150_000, exponent: 0.5, lead_us: 40_000 }
    }
}

/// The loud frames are louder than so many percent of all frames.
const LOUD_PERCENT: usize = 95;

/// Returns a lip-sync track of type `rms` from the loudness of `sound`: `9` where the voice is loud, `0` where it is
/// quiet, `-` in pauses. Without a transcript, it also reacts to noise.
pub fn rms(sound: &Sound, fps: Fps, rules: &RmsRules) -> Mouth {
    let power = voice_powers(sound.spectrum());
    let mut sorted = power.clone();
    let loud = match sorted.len() {
        0 => 0.0,
        count => *sorted.select_nth_unstable_by((count - 1) * LOUD_PERCENT / 100, f32::total_cmp).1,
    };
    let count = frames::count(sound.duration_us(), fps);
    let is_silent = decibels(loud) < SILENT_DB;
    let digit = |frame| {
        let level = mean(&power, frame, fps, rules.lead_us) / loud;
        if is_silent || decibels(level) < -rules.threshold_db {
            return b'0';
        }
        let opening = 9.0 * libm::powf(level.min(1.0), rules.exponent / 2.0);
        (1..=9).rev().find(|&digit| opening >= f32::from(digit) - 0.5).map_or(b'1', |digit| b'0' + digit)
    };
    let mut codes: Vec<u8> = (0..count).map(digit).collect();
    rest(&mut codes, frames::first_at(rules.shortest_pause_us, fps).max(1));
    Mouth { frames: codes.into_iter().map(char::from).collect(), segment_starts: vec![0] }
}

/// Returns the mean power during a frame of the track.
fn mean(power: &[f32], frame: usize, fps: Fps, lead_us: u64) -> f32 {
    // The time of a frame of the features is the middle of its samples.
    let offset_us = (WINDOW as u64 - HOP as u64) * 500_000 / u64::from(RATE_HZ);
    let hop_us = HOP as u64 * 1_000_000 / u64::from(RATE_HZ);
    let index = |time_us: u64| usize::try_from(time_us.saturating_sub(offset_us) / hop_us).unwrap_or(usize::MAX);
    let centre_us = frames::centre_us(frame, fps) + lead_us;
    let half_us = frames::centre_us(0, fps);
    let start = index(centre_us - half_us.min(centre_us)).min(power.len());
    let end = index(centre_us + half_us).max(start + 1).min(power.len());
    match &power[start..end.max(start)] {
        [] => 0.0,
        powers => powers.iter().sum::<f32>() / powers.len() as f32,
    }
}

/// Replaces closed frames with rest in runs of at least `frames`.
fn rest(codes: &mut [u8], frames: usize) {
    for run in codes.chunk_by_mut(|a, b| (*a == b'0') == (*b == b'0')) {
        if run.first() == Some(&b'0') && run.len() >= frames {
            run.fill(b'-');
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f32::consts::TAU;

    /// Returns a hum with these amplitudes, each for a quarter of a second.
    fn hum(amplitudes: &[f32]) -> Sound {
        let sample = |(i, amplitude): (usize, f32)| {
            amplitude * (1..20).map(|k| (TAU * (i * k * 150 % 16_000) as f32 / 16_000.0).sin()).sum::<f32>() / 20.0
        };
        let amplitudes = amplitudes.iter().flat_map(|&amplitude| [amplitude; 4_000]);
        Sound::from_samples(&amplitudes.enumerate().map(sample).collect::<Vec<_>>(), 16_000).unwrap()
    }

    #[test]
    fn louder_is_wider_and_pauses_rest() {
        let rules = RmsRules { lead_us: 0, ..RmsRules::default() };
        let mouth = rms(&hum(&[0.0, 0.5, 0.05, 0.5, 0.0, 0.0]), Fps::whole(24), &rules);
        assert_eq!(mouth.frames.len(), 36);
        assert_eq!(mouth.segment_starts, [0]);
        let at = |quarter: usize| &mouth.frames[quarter * 6 + 2..quarter * 6 + 4];
        assert_eq!((at(0), at(1), at(3), at(4), at(5)), ("--", "99", "99", "--", "--"), "{}", mouth.frames);
        assert!(("22".."55").contains(&at(2)), "{}", mouth.frames);
    }

    #[test]
    fn the_volume_of_the_recording_makes_no_difference() {
        let rules = RmsRules::default();
        let fps = Fps::whole(30);
        assert_eq!(rms(&hum(&[0.0, 0.8, 0.1, 0.4]), fps, &rules), rms(&hum(&[0.0, 0.08, 0.01, 0.04]), fps, &rules));
    }

    #[test]
    fn silence_rests() {
        for amplitude in [0.0, 1e-4] {
            assert_eq!(rms(&hum(&[amplitude; 4]), Fps::whole(24), &RmsRules::default()).frames, "-".repeat(24));
        }
        let short = Sound::from_samples(&[0.1; 3], 16_000).unwrap();
        assert_eq!(rms(&short, Fps::whole(24), &RmsRules::default()).frames.len(), 1);
    }
}
