//! Motions of Live2D's Cubism, `.motion3.json`: curves of parameters.

use super::keys::{WeightKey, keys};
use super::{FaceAnimation, WeightFormat};
use lipz_diagnostics::Diagnostic;
use serde_json::{Value, json};

/// The identifier of a linear segment.
const LINEAR: u32 = 0;

pub(super) const FORMAT: WeightFormat = WeightFormat {
    name: "live2d",
    about: "Live2D Cubism motions, .motion3.json",
    extension: "motion3.json",
    rig: "live2d",
    fixed_rate: None,
    write,
};

fn write(animation: &FaceAnimation, _: &mut Vec<Diagnostic>) -> Vec<u8> {
    let (mut curves, mut segments, mut points) = (Vec::new(), 0, 0);
    for weight in &animation.weights {
        let keys = keys(animation, weight);
        segments += keys.len().saturating_sub(1);
        points += keys.len();
        curves.push(json!({ "Target": "Parameter", "Id": weight.name, "Segments": flat(&keys) }));
    }
    let file = json!({
        "Version": 3,
        "Meta": {
            "Duration": rounded(animation.duration_seconds()),
            "Fps": animation.frames_per_second(),
            "Loop": false,
            "AreBeziersRestricted": true,
            "CurveCount": curves.len(),
            "TotalSegmentCount": segments,
            "TotalPointCount": points,
            "UserDataCount": 0,
            "TotalUserDataSize": 0,
        },
        "Curves": curves,
    });
    format!("{file}\n").into_bytes()
}

/// Returns the first point, and for each other point the identifier of its segment before it.
fn flat(keys: &[WeightKey]) -> Vec<Value> {
    let mut numbers = Vec::with_capacity(keys.len() * 3);
    for (index, key) in keys.iter().enumerate() {
        if index > 0 {
            numbers.push(json!(LINEAR));
        }
        numbers.extend([json!(rounded(key.seconds)), json!(key.value)]);
    }
    numbers
}

/// Returns a time with at most six decimal places.
fn rounded(seconds: f64) -> f64 {
    (seconds * 1e6).round() / 1e6
}
