//! Animations of Godot 4, `.tres`: blend shapes of the node `Face`.

use super::keys::{keys, quoted, spell};
use super::{FaceAnimation, WeightFormat};
use lipz_diagnostics::Diagnostic;
use std::fmt::Write;

/// The node with the mesh, relative to the root node of the animation player.
const NODE: &str = "Face";
/// How a value gets from one key to the next: evenly.
const TRANSITION: &str = "1";

pub(super) const FORMAT: WeightFormat = WeightFormat {
    name: "godot",
    about: "Godot 4 animations of blend shapes, .tres",
    extension: "tres",
    rig: "arkit",
    fixed_rate: None,
    write,
};

fn write(animation: &FaceAnimation, _: &mut Vec<Diagnostic>) -> Vec<u8> {
    let mut file = format!(
        "[gd_resource type=\"Animation\" format=3]\n\n[resource]\nresource_name = {}\nlength = {}\nstep = {}\n",
        quoted(&animation.name),
        spell(animation.duration_seconds()),
        spell(animation.seconds(1)),
    );
    for (track, weight) in animation.weights.iter().enumerate() {
        let numbers: Vec<String> = keys(animation, weight)
            .iter()
            .flat_map(|key| [spell(key.seconds), TRANSITION.to_owned(), spell(key.value)])
            .collect();
        let path = quoted(&format!("{NODE}:{}", weight.name));
        // Writing to a string cannot fail.
        let _ = write!(
            file,
            "tracks/{track}/type = \"blend_shape\"\ntracks/{track}/imported = false\ntracks/{track}/enabled = true\n\
             tracks/{track}/path = NodePath({path})\ntracks/{track}/interp = 1\ntracks/{track}/loop_wrap = false\n\
             tracks/{track}/keys = PackedFloat32Array({})\n",
            numbers.join(", ")
        );
    }
    file.into_bytes()
}
