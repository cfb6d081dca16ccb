//! Keys of weights, for formats that interpolate between keys.

use super::{FaceAnimation, KEY_TOLERANCE, SampledWeight};
use lipz_file::curve;

/// A key: a time, and the weight at this time.
pub(super) struct WeightKey {
    /// The frame.
    pub(super) frame: u32,
    /// The time in seconds.
    pub(super) seconds: f64,
    /// The weight.
    pub(super) value: f64,
}

/// Returns the keys of a shape, at least one. Between them, weights change evenly.
pub(super) fn keys(animation: &FaceAnimation, weight: &SampledWeight) -> Vec<WeightKey> {
    let key = |(frame, value): (u32, lipz_types::CurveValue)| WeightKey {
        frame,
        seconds: animation.seconds(frame),
        value: f64::from(value.thousandths()) / 1000.0,
    };
    curve::sampled(&weight.values, KEY_TOLERANCE).into_iter().map(key).collect()
}

/// Returns a number with at most six decimal places, without zeros at its end.
pub(super) fn spell(number: f64) -> String {
    let text = format!("{number:.6}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// Returns a string in double quotes, as Godot's text resources and YAML spell it.
pub(super) fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\"").replace('\n', "\\n"))
}
