//! Where nobody speaks, whatever the noise sounds like: long stretches that are far below the voice.

use crate::features::mel::Spectrum;
use crate::sound::level::{decibels, voice_powers};

/// How far below the loud frames of the sound these stretches are, in decibels. In recordings of speech with noise 20 decibels
/// below it, all pauses of a second are; of 21 minutes of speech, one second is.
const DEPTH_DB: f32 = 18.0;
/// So many frames as quiet as that are a pause: 0.4 seconds, longer than the closure of any stop.
const LEAST_FRAMES: usize = 40;
/// A word fades before a pause and rises after it: so many frames at both ends may be speech.
const EDGE_FRAMES: usize = 8;
/// Where no script says when words end, so many more. With none more, 73.0 % of the frames of three human sentences are right
/// without a script; with 12 and with 16, 76.2 %, and noise moves the mouth in no other pause.
const LOOSE_EDGE_FRAMES: usize = 12;
/// Of the frames of a sound, so many percent are not louder than the loud ones.
const LOUD_PERCENT: usize = 95;

/// By frame: whether it is in such a stretch.
pub(super) fn quiet(spectrum: &[Spectrum]) -> Vec<bool> {
    let mut quiet = far_below_the_voice(&voice_powers(spectrum), DEPTH_DB);
    for run in quiet.chunk_by_mut(|a, b| a == b).filter(|run| run[0] && run.len() < LEAST_FRAMES) {
        run.fill(false);
    }
    shorten(&mut quiet, EDGE_FRAMES);
    quiet
}

/// By frame: whether it is so far inside of such a stretch that it cannot be a word, even if no script says where words are.
pub(super) fn deep(quiet: &[bool]) -> Vec<bool> {
    let mut deep = quiet.to_vec();
    shorten(&mut deep, LOOSE_EDGE_FRAMES);
    deep
}

/// Takes so many frames away from each stretch at both ends.
fn shorten(stretches: &mut [bool], edge: usize) {
    for run in stretches.chunk_by_mut(|a, b| a == b).filter(|run| run[0]) {
        let edge = edge.min(run.len());
        let end = run.len() - edge;
        run[..edge].fill(false);
        run[end..].fill(false);
    }
}

/// By frame: whether it is so many decibels below the loud frames of the sound.
fn far_below_the_voice(powers: &[f32], depth_db: f32) -> Vec<bool> {
    let loud = loud(powers);
    powers.iter().map(|power| decibels(power / loud) < -depth_db).collect()
}

/// How loud the loud frames are; never 0.
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

    /// Frames of noise, of so many frames and decibels below the loudest.
    fn noise(parts: &[(usize, f32)]) -> Vec<Spectrum> {
        let frame = |db: f32| -> Spectrum {
            #[expect(clippy::cast_possible_truncation, reason = "within the range of spectra")]
            std::array::from_fn(|_| (15_000.0 - db * 1024.0 / 4.342_945) as i16)
        };
        parts.iter().flat_map(|&(count, db)| vec![frame(db); count]).collect()
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
        assert!(quiet(&[]).is_empty());
    }
}
