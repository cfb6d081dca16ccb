//! The mouth of a player, for drawing.

use bevy::ecs::component::Component;
use bevy::ecs::reflect::ReflectComponent;
use bevy::reflect::Reflect;

/// The mouth of a player. Each [`LipzPlayer`](crate::LipzPlayer) has one; read it to draw the mouth yourself.
///
/// The mouth rests before and after the line, while the player is paused, and after the player was removed.
#[derive(Component, Reflect, Clone, Copy, PartialEq, Debug)]
#[reflect(Component)]
pub struct LipzMouth {
    /// The code of the viseme, in the viseme type of the clip; `-` is rest.
    pub viseme: char,
    /// How far the mouth is open, from 0 to 0.99; `None` if the clip does not have frames or a viseme type.
    pub openness: Option<f32>,
}

impl LipzMouth {
    /// The mouth at rest.
    pub const REST: LipzMouth = LipzMouth { viseme: '-', openness: Some(0.0) };
}

impl Default for LipzMouth {
    fn default() -> Self {
        LipzMouth::REST
    }
}
