//! Faces in 3D: the morph targets of a model.

mod names;
mod shapes;
mod systems;

pub use shapes::LipzShapes;
pub(crate) use systems::{find_shapes, move_faces};

use bevy::ecs::component::Component;
use bevy::ecs::entity::Entity;
use bevy::ecs::reflect::ReflectComponent;
use bevy::reflect::Reflect;

/// Moves the morph targets of a model while a player plays: those of its entity and of all entities below it that have
/// `MorphWeights`, such as head, teeth and tongue of a glTF scene.
///
/// The morph targets are found by their names, with the rigs of the bank: `[rig] arkit = true` in `lipz.toml` adds the
/// one of ARKit. A model with a morph target for each viseme (`Mouth_A`, `Mouth_E` …) does not need a rig.
#[derive(Component, Reflect, Clone, PartialEq, Eq, Debug, Default)]
#[reflect(Component)]
pub struct LipzFace {
    /// The player. `None` for the player of the same entity, or of its nearest ancestor with one.
    pub player: Option<Entity>,
    /// The name of the rig. If it is empty, the names of the morph targets decide.
    pub rig: String,
    /// The character whose face it is; empty for the speaker. A different character listens: the mouth rests, and
    /// emotions, brows and lids move.
    pub character: String,
}
