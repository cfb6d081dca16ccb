//! The opening of the lips in recordings without a text, as a curve: the targets of all phones, blended by their
//! probabilities.
//!
//! The best phones move the jaw and round the lips as well as probabilities do, but they follow the opening worse: on
//! the utterances of `cargo xtask mouth-score`, with r 0.47 instead of 0.60.

use lipz_compiler::articulation::{TARGET_NAMES, phone_targets};
use lipz_file::curve;
use lipz_speech::{AlignedPhone, Aligner, Phone, Sound};
use lipz_types::{CurveValue, Fps};

/// The name of the curve, and of the target.
pub(super) const NAME: &str = "opening";

/// The microseconds between two frames of probabilities.
const STEP_US: u64 = 10_000;
/// The weight of a frame in a moving average with a time constant of 30 ms: 1 - e^(-10/30).
const SMOOTHING: f32 = 0.283_468_7;
/// The largest distance of the curve from its values, in thousandths.
const TOLERANCE: i32 = 20;

/// Returns the keys of the curve for a recording with these recognised phones, and a clip with this number of frames. In
/// the pauses between the phones, the mouth rests.
pub(super) fn keys(
    aligner: &Aligner<'_>,
    sound: &Sound,
    phones: &[AlignedPhone],
    fps: Fps,
    frame_count: usize,
) -> Vec<(u32, CurveValue)> {
    let place = TARGET_NAMES.iter().position(|name| *name == NAME).unwrap_or_default();
    let target = |phone: Phone| {
        let percent = phone.name().parse().map(phone_targets).unwrap_or_default();
        f32::from(percent[place]) / 100.0
    };
    let (targets, rest) = (Phone::ALL.map(target), target(Phone::Sil));
    let is_pause = |time_us: u64| {
        let index = phones.partition_point(|phone| phone.end_us <= time_us);
        phones.get(index).is_none_or(|phone| !phone.phone.is_speech() && phone.phone != Phone::Spoken)
    };
    let mut steps: Vec<f32> = Vec::new();
    for probabilities in aligner.posteriors(sound) {
        let blended = probabilities.iter().zip(targets).map(|(probability, target)| probability * target).sum();
        steps.push(if is_pause(steps.len() as u64 * STEP_US) { rest } else { blended });
    }
    smooth(&mut steps);
    // Backwards as well, so that nothing is late.
    steps.reverse();
    smooth(&mut steps);
    steps.reverse();
    let sample = |frame: usize| {
        let us = fps.start_of_frame_us(u32::try_from(frame).unwrap_or(u32::MAX));
        let step = usize::try_from((us + STEP_US / 2) / STEP_US).unwrap_or(usize::MAX);
        let opening = steps.get(step).or(steps.last()).copied().unwrap_or(rest);
        #[expect(clippy::cast_possible_truncation, reason = "from 0 to 1000")]
        CurveValue::from_thousandths((opening * 1000.0).round() as i32)
    };
    let samples: Vec<CurveValue> = (0..frame_count).map(sample).collect();
    curve::sampled(&samples, TOLERANCE)
}

/// Averages each value with those before it.
fn smooth(steps: &mut [f32]) {
    let mut before = None;
    for step in steps {
        *step = before.map_or(*step, |before| before + SMOOTHING * (*step - before));
        before = Some(*step);
    }
}
