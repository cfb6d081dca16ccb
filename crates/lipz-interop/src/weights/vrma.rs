//! VRM animations, `.vrma`: expressions of VRM 1.0, each by the movement of a node along x (extension
//! `VRMC_vrm_animation`).

use super::glb::GlbBuffer;
use super::keys::keys;
use super::{FaceAnimation, WeightFormat};
use lipz_diagnostics::Diagnostic;
use serde_json::{Map, Value, json};

const EXTENSION: &str = "VRMC_vrm_animation";
/// The height of the hips. Loaders scale movements by it, and expect it to be above the ground.
const HIPS_METRES: f64 = 1.0;
/// The expressions that VRM 1.0 defines. All others are custom ones.
const PRESETS: [&str; 18] = [
    "happy",
    "angry",
    "sad",
    "relaxed",
    "surprised",
    "aa",
    "ih",
    "ou",
    "ee",
    "oh",
    "blink",
    "blinkLeft",
    "blinkRight",
    "lookUp",
    "lookDown",
    "lookLeft",
    "lookRight",
    "neutral",
];

pub(super) const FORMAT: WeightFormat = WeightFormat {
    name: "vrma",
    about: "VRM animations of expressions, .vrma",
    extension: "vrma",
    rig: "vrm",
    fixed_rate: None,
    write,
};

#[expect(clippy::cast_possible_truncation, reason = "glTF stores times and weights as f32")]
fn write(animation: &FaceAnimation, _: &mut Vec<Diagnostic>) -> Vec<u8> {
    let mut buffer = GlbBuffer::default();
    let (mut nodes, mut channels, mut samplers) = (Vec::new(), Vec::new(), Vec::new());
    let (mut presets, mut custom) = (Map::new(), Map::new());
    for (node, weight) in animation.weights.iter().enumerate() {
        let keys = keys(animation, weight);
        let times: Vec<f32> = keys.iter().map(|key| key.seconds as f32).collect();
        let values: Vec<f32> = keys.iter().flat_map(|key| [key.value as f32, 0.0, 0.0]).collect();
        let (input, output) = (buffer.floats(&times, 1, "SCALAR"), buffer.floats(&values, 3, "VEC3"));
        nodes.push(json!({ "name": weight.name }));
        samplers.push(json!({ "input": input, "output": output, "interpolation": "LINEAR" }));
        channels.push(json!({ "sampler": node, "target": { "node": node, "path": "translation" } }));
        let expressions = if PRESETS.contains(&weight.name.as_str()) { &mut presets } else { &mut custom };
        expressions.insert(weight.name.clone(), json!({ "node": node }));
    }
    let hips = nodes.len();
    nodes.push(json!({ "name": "hips", "translation": [0.0, HIPS_METRES, 0.0] }));
    let mut expressions = Map::new();
    for (name, group) in [("preset", presets), ("custom", custom)] {
        if !group.is_empty() {
            expressions.insert(name.to_owned(), Value::Object(group));
        }
    }
    buffer.file(json!({
        "extensionsUsed": [EXTENSION],
        "extensions": { EXTENSION: {
            "specVersion": "1.0",
            "humanoid": { "humanBones": { "hips": { "node": hips } } },
            "expressions": expressions,
        } },
        "scene": 0,
        "scenes": [{ "nodes": (0..nodes.len()).collect::<Vec<_>>() }],
        "nodes": nodes,
        "animations": [{ "name": animation.name, "channels": channels, "samplers": samplers }],
    }))
}
