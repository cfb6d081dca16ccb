//! Mouths in 2D: the pictures of a sprite sheet.

use crate::LipzMouth;
use crate::hierarchy::nearest;
use bevy::ecs::component::Component;
use bevy::ecs::entity::Entity;
use bevy::ecs::hierarchy::ChildOf;
use bevy::ecs::reflect::ReflectComponent;
use bevy::ecs::system::Query;
use bevy::reflect::Reflect;
use bevy::sprite::Sprite;

/// Shows the viseme of a player with a sprite sheet: sets the index of the texture atlas in the `Sprite` of the same
/// entity.
#[derive(Component, Reflect, Clone, PartialEq, Eq, Debug)]
#[reflect(Component)]
pub struct LipzSprite {
    /// The visemes in the order of the pictures, such as `-AEFLMOSUW`. A viseme without a picture is shown as `-`, and
    /// without that as the first picture.
    pub order: String,
    /// The player. `None` for the player of the same entity, or of its nearest ancestor with one.
    pub player: Option<Entity>,
}

impl LipzSprite {
    /// Returns a sprite with pictures in this order.
    #[must_use]
    pub fn new(order: impl Into<String>) -> LipzSprite {
        LipzSprite { order: order.into(), player: None }
    }

    fn index(&self, viseme: char) -> usize {
        let place = |viseme| self.order.chars().position(|other| other == viseme);
        place(viseme).or_else(|| place('-')).unwrap_or(0)
    }
}

/// The visemes of `blair` in the order of a sheet of ten pictures: `-AEFLMOSUW`.
impl Default for LipzSprite {
    fn default() -> Self {
        LipzSprite::new("-AEFLMOSUW")
    }
}

/// Sets the pictures of all sprites.
pub(crate) fn show_sprites(
    mouths: Query<&LipzMouth>,
    parents: Query<&ChildOf>,
    mut sprites: Query<(Entity, &LipzSprite, &mut Sprite)>,
) {
    for (entity, lipz, mut sprite) in &mut sprites {
        let player = lipz.player.or_else(|| nearest(entity, &parents, |entity| mouths.contains(entity)));
        let mouth = player.and_then(|player| mouths.get(player).ok()).copied().unwrap_or_default();
        let index = lipz.index(mouth.viseme);
        if sprite.texture_atlas.as_ref().is_some_and(|atlas| atlas.index != index)
            && let Some(atlas) = &mut sprite.texture_atlas
        {
            atlas.index = index;
        }
    }
}
