//! Scripts for Blender, `.py`: keys for the shape keys of the active object.

use super::keys::keys;
use super::{FaceAnimation, WeightFormat};
use lipz_diagnostics::Diagnostic;
use serde_json::json;

/// The part of the script after the data. `keyframe_insert` exists in all versions with shape keys.
const APPLY: &str = r#"

def curves(action):
    """Returns the curves of an action: in layers since Blender 4.4, and directly before."""
    layers = getattr(action, "layers", None)
    if not layers:
        return list(action.fcurves)
    bags = (bag for layer in layers for strip in layer.strips for bag in strip.channelbags)
    return [curve for bag in bags for curve in bag.fcurves]


def apply(face, data, start=None):
    """Keys the shape keys of `face` that the animation has. Returns the names of those that the face lacks."""
    scene = bpy.context.scene
    start = scene.frame_current if start is None else start
    rate = scene.render.fps / scene.render.fps_base
    shape_keys = face.data.shape_keys
    blocks = shape_keys.key_blocks if shape_keys else {}
    found = {name: keys for name, keys in data["weights"].items() if name in blocks}
    for name, keys in found.items():
        for seconds, weight in keys:
            blocks[name].value = weight
            blocks[name].keyframe_insert("value", frame=start + seconds * rate)
    if found:
        paths = {blocks[name].path_from_id("value"): keys for name, keys in found.items()}
        for curve in curves(shape_keys.animation_data.action):
            if curve.data_path in paths:
                end = start + paths[curve.data_path][-1][0] * rate
                for point in curve.keyframe_points:
                    if start - 0.01 <= point.co.x <= end + 0.01:
                        point.interpolation = "LINEAR"
    return [name for name in data["weights"] if name not in found]


if __name__ == "__main__":
    face = bpy.context.object
    if face is None or face.type != "MESH":
        raise SystemExit("select the mesh of the face, then run this script")
    missing = apply(face, DATA)
    if missing:
        print("shape keys that the face lacks:", ", ".join(missing))
"#;

pub(super) const FORMAT: WeightFormat = WeightFormat {
    name: "blender",
    about: "Blender scripts that key shape keys, .py",
    extension: "py",
    rig: "arkit",
    fixed_rate: None,
    write,
};

fn write(animation: &FaceAnimation, _: &mut Vec<Diagnostic>) -> Vec<u8> {
    let mut script =
        "\"\"\"Keys the shape keys of the active object, from the current frame. Written by lipz.\"\"\"\n\n\
        import json\n\nimport bpy\n\nDATA = json.loads(r\"\"\"\n"
            .to_owned();
    let keys_of = |weight: &super::SampledWeight| -> serde_json::Value {
        keys(animation, weight).into_iter().map(|key| json!([(key.seconds * 1e6).round() / 1e6, key.value])).collect()
    };
    let weights: serde_json::Map<_, _> =
        animation.weights.iter().map(|weight| (weight.name.clone(), keys_of(weight))).collect();
    // JSON escapes quotes in strings, so no three of them follow each other.
    script += &json!({ "name": animation.name, "weights": weights }).to_string();
    script += "\n\"\"\")\n";
    script += APPLY;
    script.into_bytes()
}
