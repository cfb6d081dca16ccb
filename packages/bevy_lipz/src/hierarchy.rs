//! The nearest entity with a component: the entity itself, or one of its ancestors.

use bevy::ecs::entity::Entity;
use bevy::ecs::hierarchy::ChildOf;
use bevy::ecs::system::Query;

/// Returns the first of `entity`, its parent, its parent's parent and so on for which `is_one` returns true.
pub(crate) fn nearest(entity: Entity, parents: &Query<&ChildOf>, is_one: impl Fn(Entity) -> bool) -> Option<Entity> {
    std::iter::once(entity).chain(parents.iter_ancestors(entity)).find(|entity| is_one(*entity))
}
