//! Skeletons of Spine, JSON: a control bone for each shape, which moves along x by its weight. Transform constraints of
//! your skeleton can follow these bones.

use super::keys::keys;
use super::{FaceAnimation, WeightFormat};
use lipz_diagnostics::Diagnostic;
use serde_json::{Map, Value, json};

/// The distance that a bone moves for the weight 1, in pixels.
const PIXELS: f64 = 100.0;

pub(super) const FORMAT: WeightFormat = WeightFormat {
    name: "spine",
    about: "Spine skeletons with a control bone per shape, JSON",
    extension: "json",
    rig: "arkit",
    fixed_rate: None,
    write,
};

fn write(animation: &FaceAnimation, _: &mut Vec<Diagnostic>) -> Vec<u8> {
    let mut bones = vec![json!({ "name": "root" })];
    let mut timelines = Map::new();
    for weight in &animation.weights {
        bones.push(json!({ "name": weight.name, "parent": "root" }));
        let key = |key: super::keys::WeightKey| json!({ "time": (key.seconds * 1e4).round() / 1e4, "x": (key.value * PIXELS * 10.0).round() / 10.0 });
        let keys: Vec<Value> = keys(animation, weight).into_iter().map(key).collect();
        timelines.insert(weight.name.clone(), json!({ "translate": keys }));
    }
    let mut animations = Map::new();
    animations.insert(animation.name.clone(), json!({ "bones": timelines }));
    let file = json!({
        "skeleton": { "spine": "4.2.0", "fps": animation.frames_per_second() },
        "bones": bones,
        "animations": animations,
    });
    format!("{file}\n").into_bytes()
}
