//! Animations of NVIDIA's Audio2Face, JSON: the names of the shapes, and a row of weights per frame.

use super::{FaceAnimation, WeightFormat};
use lipz_diagnostics::Diagnostic;
use lipz_file::curve::ARKIT;
use serde_json::json;

pub(super) const FORMAT: WeightFormat = WeightFormat {
    name: "audio2face",
    about: "Audio2Face animations (ARKit), JSON",
    extension: "json",
    rig: "arkit",
    fixed_rate: None,
    write,
};

/// Writes all shapes of ARKit, as importers of these files expect, and after them the other shapes.
fn write(animation: &FaceAnimation, _: &mut Vec<Diagnostic>) -> Vec<u8> {
    let is_arkit = |name: &str| ARKIT.iter().any(|known| known.eq_ignore_ascii_case(name));
    let others: Vec<usize> =
        (0..animation.weights.len()).filter(|&index| !is_arkit(animation.weights[index].name.as_str())).collect();
    let own = others.iter().map(|&index| animation.weights[index].name.as_str());
    let names: Vec<&str> = ARKIT.into_iter().chain(own).collect();
    let indices: Vec<Option<usize>> =
        ARKIT.iter().map(|name| animation.index_of(name)).chain(others.iter().copied().map(Some)).collect();
    let weight = |index: &Option<usize>, frame: usize| {
        let value = index.and_then(|index| animation.weights.get(index)?.values.get(frame)).copied();
        f64::from(value.unwrap_or_default().thousandths()) / 1000.0
    };
    let rows: Vec<Vec<f64>> =
        (0..animation.frame_count).map(|frame| indices.iter().map(|index| weight(index, frame)).collect()).collect();
    let file = json!({
        "exportFps": animation.frames_per_second(),
        "trackPath": animation.name,
        "numPoses": names.len(),
        "numFrames": animation.frame_count,
        "facsNames": names,
        "weightMat": rows,
    });
    format!("{file}\n").into_bytes()
}
