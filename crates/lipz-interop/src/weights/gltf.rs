//! glTF animations, `.glb`: the weights of morph targets. The mesh is a single triangle without size, which has the
//! targets; engines play the animation on a head with targets of the same names.

use super::glb::GlbBuffer;
use super::{FaceAnimation, WeightFormat};
use lipz_diagnostics::Diagnostic;
use serde_json::json;

/// The coordinates of the triangle, at the origin.
const TRIANGLE: [f32; 9] = [0.0; 9];

pub(super) const FORMAT: WeightFormat = WeightFormat {
    name: "gltf",
    about: "glTF animations of morph targets, .glb",
    extension: "glb",
    rig: "arkit",
    fixed_rate: None,
    write,
};

fn write(animation: &FaceAnimation, _: &mut Vec<Diagnostic>) -> Vec<u8> {
    let mut buffer = GlbBuffer::default();
    let position = buffer.floats(&TRIANGLE, 3, "VEC3");
    let frames = u32::try_from(animation.frame_count).unwrap_or(u32::MAX);
    #[expect(clippy::cast_possible_truncation, reason = "glTF stores times and weights as f32")]
    let times: Vec<f32> = (0..frames).map(|frame| animation.seconds(frame) as f32).collect();
    let input = buffer.floats(&times, 1, "SCALAR");
    let value = |frame: usize| {
        let of_frame =
            move |weight: &super::SampledWeight| weight.values.get(frame).map_or(0.0, |value| value.to_f32());
        animation.weights.iter().map(of_frame)
    };
    let values: Vec<f32> = (0..animation.frame_count).flat_map(value).collect();
    let output = buffer.floats(&values, 1, "SCALAR");
    let names: Vec<&str> = animation.weights.iter().map(|weight| weight.name.as_str()).collect();
    let targets = vec![json!({ "POSITION": position }); names.len()];
    buffer.file(json!({
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "name": "Face", "mesh": 0 }],
        "meshes": [{
            "name": "Face",
            "primitives": [{ "attributes": { "POSITION": position }, "targets": targets }],
            "weights": vec![0; names.len()],
            "extras": { "targetNames": names },
        }],
        "animations": [{
            "name": animation.name,
            "channels": [{ "sampler": 0, "target": { "node": 0, "path": "weights" } }],
            "samplers": [{ "input": input, "output": output, "interpolation": "LINEAR" }],
        }],
    }))
}
