//! Detection of pauses in any kind of noise: long stretches that are far below the voice.

use crate::features::spectrogram::Spectrogram;
use crate::sound::level::{decibels, voice_powers};

/// The distance between these stretches and the loud frames of the recording, in decibels. In speech with noise 20
/// decibels below it, this includes every pause of a second; in 21 minutes of speech, it includes one second of speech.
const DEPTH_DB: f32 = 18.0;
/// A pause has at least so many quiet frames: 0.4 seconds, longer than the closure of any stop.
const LEAST_FRAMES: usize = 40;
/// So many frames at both ends of a pause may be speech, because words fade before a pause and rise after it.
const EDGE_FRAMES: usize = 8;
/// The additional frames if there is no script to state where words end. With 0, 73.0 % of the frames of three human
/// sentences are right without a script; with 12 and with 16, 76.2 %, and noise moves the mouth in no other pause.
const LOOSE_EDGE_FRAMES: usize = 12;
/// The loud frames are louder than so many percent of all frames.
const LOUD_PERCENT: usize = 95;

/// Returns, by frame, whether it is in such a stretch.
pub(super) fn quiet(spectrum: &Spectrogram) -> Vec<bool> {
    let mut quiet = far_below_the_voice(&voice_powers(spectrum), DEPTH_DB);
    for run in quiet.chunk_by_mut(|a, b| a == b).filter(|run| run[0] && run.len() < LEAST_FRAMES) {
        run.fill(false);
    }
    shorten(&mut quiet, EDGE_FRAMES);
    quiet
}

/// Returns, by frame, whether it is so deep inside such a stretch that it cannot be part of a word, even without a
/// script.
pub(super) fn deep(quiet: &[bool]) -> Vec<bool> {
    let mut deep = quiet.to_vec();
    shorten(&mut deep, LOOSE_EDGE_FRAMES);
    deep
}

/// Shortens each stretch by `edge` frames at both ends.
fn shorten(stretches: &mut [bool], edge: usize) {
    for run in stretches.chunk_by_mut(|a, b| a == b).filter(|run| run[0]) {
        let edge = edge.min(run.len());
        let end = run.len() - edge;
        run[..edge].fill(false);
        run[end..].fill(false);
    }
}

/// Returns, by frame, whether it is so many decibels below the loud frames of the recording.
fn far_below_the_voice(powers: &[f32], depth_db: f32) -> Vec<bool> {
    let loud = loud(powers);
    powers.iter().map(|power| decibels(power / loud) < -depth_db).collect()
}

/// Returns the power of the loud frames, which is never 0.
pub(super) fn loud(powers: &[f32]) -> f32 {
    let mut sorted = powers.to_vec();
    let loud = match sorted.len() {
        0 => 0.0,
        count => *sorted.select_nth_unstable_by((count - 1) * LOUD_PERCENT / 100, f32::total_cmp).1,
    };
    loud.max(f32::MIN_POSITIVE)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::features::mel::Spectrum;

    /// Returns frames of noise, from pairs of the number of frames and the level in decibels relative to the loudest.
    fn noise(parts: &[(usize, f32)]) -> Spectrogram {
        let frame = |db: f32| -> Spectrum {
            #[expect(clippy::cast_possible_truncation, reason = "within the range of spectra")]
            std::array::from_fn(|_| (15_000.0 - db * 1024.0 / 4.342_945) as i16)
        };
        parts.iter().flat_map(|&(count, db)| vec![frame(db); count]).collect::<Vec<_>>().into()
    }

    fn runs(parts: &[(usize, f32)]) -> Vec<(bool, usize)> {
        quiet(&noise(parts)).chunk_by(|a, b| a == b).map(|run| (run[0], run.len())).collect()
    }

    #[test]
    fn long_stretches_far_below_the_voice_are_quiet() {
        let edges = |count: usize| count - 2 * EDGE_FRAMES;
        assert_eq!(runs(&[(100, 0.0), (100, 20.0), (100, 0.0)]), [(false, 108), (true, edges(100)), (false, 108)]);
        assert_eq!(runs(&[(100, 0.0), (100, 15.0), (100, 0.0)]), [(false, 300)]);
        assert_eq!(runs(&[(100, 0.0), (LEAST_FRAMES - 1, 40.0), (100, 0.0)]), [(false, 239)]);
    }

    #[test]
    fn deep_inside_is_what_is_far_from_both_ends() {
        let deep = |count: usize| deep(&quiet(&noise(&[(100, 0.0), (count, 20.0), (100, 0.0)])));
        let edge = EDGE_FRAMES + LOOSE_EDGE_FRAMES;
        let runs: Vec<_> = deep(100).chunk_by(|a, b| a == b).map(|run| (run[0], run.len())).collect();
        assert_eq!(runs, [(false, 100 + edge), (true, 100 - 2 * edge), (false, 100 + edge)]);
        assert_eq!(deep(LEAST_FRAMES), [false; 200 + LEAST_FRAMES], "nothing is left of a short one");
    }

    #[test]
    fn what_is_equally_loud_or_silent_everywhere_has_no_quiet_stretch() {
        assert_eq!(runs(&[(200, 0.0)]), [(false, 200)]);
        assert_eq!(runs(&[(200, 60.0)]), [(false, 200)]);
        assert!(quiet(&Vec::new().into()).is_empty());
    }
}
