//! The parts of a recording that are audible. The rest is silence, however long.

use super::level::{SILENT_DB, decibels, voice_powers};
use crate::features::spectrogram::Spectrogram;
use std::ops::Range;

/// The distance between the voice and silence, in decibels. Breaths are up to 35 decibels below the voice.
const DEPTH_DB: f32 = 40.0;
/// The voice has its level for so many frames, which clicks do not: 50 milliseconds.
const LEVEL_FRAMES: usize = 5;
/// The most frames of silence on each side that are kept: a little more than the shortest pause. With 15, 0.3 % fewer
/// frames of synthetic English are right.
const SILENT_FRAMES: usize = 18;

/// Returns the level of the voice, in decibels relative to full scale.
pub(crate) fn level_db(spectrum: &Spectrogram) -> f32 {
    decibels(level(&voice_powers(spectrum)))
}

/// Returns the audible parts, each with a little of the silence around it; empty if nothing is audible.
pub(crate) fn parts(spectrum: &Spectrogram) -> Vec<Range<usize>> {
    let audible = audible(&voice_powers(spectrum)).into_iter();
    let with_silence =
        |part: Range<usize>| part.start.saturating_sub(SILENT_FRAMES)..(part.end + SILENT_FRAMES).min(spectrum.len());
    audible.map(with_silence).collect()
}

/// Returns the highest power that lasts for `LEVEL_FRAMES`, or the highest of all if that is silent: a recording may be a
/// click, or shorter.
fn level(powers: &[f32]) -> f32 {
    let sustained = powers.windows(LEVEL_FRAMES).map(|window| window.iter().copied().fold(f32::MAX, f32::min));
    let level = sustained.fold(0.0, f32::max);
    if decibels(level) < SILENT_DB { powers.iter().copied().fold(0.0, f32::max) } else { level }
}

/// Returns the audible frames as parts, between which there is silence of at least twice the frames that are kept.
fn audible(powers: &[f32]) -> Vec<Range<usize>> {
    let level = level(powers);
    let mut parts: Vec<Range<usize>> = Vec::new();
    if decibels(level) < SILENT_DB {
        return parts;
    }
    let is_audible = |power: f32| decibels(power / level) > -DEPTH_DB;
    for (frame, _) in powers.iter().enumerate().filter(|(_, power)| is_audible(**power)) {
        match parts.last_mut() {
            Some(last) if frame <= last.end + 2 * SILENT_FRAMES => last.end = frame + 1,
            _ => parts.push(frame..frame + 1),
        }
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the powers of parts: frames, and decibels below the voice.
    fn powers(parts: &[(usize, f32)]) -> Vec<f32> {
        parts.iter().flat_map(|&(count, db)| vec![libm::powf(10.0, -db / 10.0); count]).collect()
    }

    #[test]
    fn parts_are_audible_whatever_the_silence_between_them() {
        assert_eq!(
            audible(&powers(&[(100, 90.0), (50, 0.0), (40, 60.0), (20, 35.0), (90, 90.0)])),
            [100..150, 190..210]
        );
        let short_pause = powers(&[(50, 0.0), (36, 60.0), (20, 10.0), (90, 90.0), (9, 0.0)]);
        assert_eq!(audible(&short_pause), [0..106, 196..205]);
        let click = powers(&[(50, 0.0), (100, 90.0), (2, -30.0), (100, 90.0)]);
        assert_eq!(audible(&click), [0..50, 150..152], "its level is not that of the voice");
        assert_eq!(audible(&[1.0; 3]).len(), 1, "shorter than a click");
        assert_eq!(audible(&powers(&[(50, 90.0), (2, 0.0), (50, 90.0)])).len(), 1, "only a click");
        assert_eq!(audible(&[0.0; 100]), []);
        assert_eq!(audible(&[]), []);
    }
}
