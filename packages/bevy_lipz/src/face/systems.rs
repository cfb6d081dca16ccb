//! The systems that recognise the morph targets of faces, and move them.

use super::{LipzFace, LipzShapes};
use crate::events::LipzFailed;
use crate::hierarchy::nearest;
use crate::{LipzBank, LipzMouth, LipzPlayer};
use bevy::asset::Assets;
use bevy::ecs::change_detection::{DetectChangesMut, Mut, Res};
use bevy::ecs::entity::Entity;
use bevy::ecs::hierarchy::ChildOf;
use bevy::ecs::system::{Commands, Query, SystemParam};
use bevy::mesh::Mesh;
use bevy::mesh::morph::MorphWeights;
use lipz_bank::face::Who;

/// Faces with their players and banks.
#[derive(SystemParam)]
pub(crate) struct Faces<'w, 's> {
    faces: Query<'w, 's, &'static LipzFace>,
    players: Query<'w, 's, (&'static LipzPlayer, &'static LipzMouth)>,
    parents: Query<'w, 's, &'static ChildOf>,
    banks: Res<'w, Assets<LipzBank>>,
}

/// The face that moves an entity, with its player and its bank.
struct FaceParts<'a> {
    face: &'a LipzFace,
    player: &'a LipzPlayer,
    mouth: &'a LipzMouth,
    bank: &'a LipzBank,
}

impl Faces<'_, '_> {
    /// Returns the face that moves an entity; `None` if it has none, or no player with a loaded bank.
    fn of(&self, entity: Entity) -> Option<FaceParts<'_>> {
        let at = nearest(entity, &self.parents, |entity| self.faces.contains(entity))?;
        let face = self.faces.get(at).ok()?;
        let player = face.player.or_else(|| nearest(at, &self.parents, |entity| self.players.contains(entity)))?;
        let (player, mouth) = self.players.get(player).ok()?;
        Some(FaceParts { face, player, mouth, bank: self.banks.get(&player.bank)? })
    }
}

/// Recognises the morph targets of new models, and again when the bank or the face has changed.
pub(crate) fn find_shapes(
    mut commands: Commands,
    (faces, meshes): (Faces, Option<Res<Assets<Mesh>>>),
    models: Query<(Entity, &MorphWeights, Option<&LipzShapes>)>,
) {
    let Some(meshes) = meshes else { return };
    for (entity, weights, shapes) in &models {
        let Some(FaceParts { face, bank, .. }) = faces.of(entity) else { continue };
        let bank = bank.bank();
        if shapes.is_some_and(|shapes| !shapes.is_outdated(bank, &face.rig)) {
            continue;
        }
        // The mesh may not be loaded yet.
        let Some(mesh) = weights.first_mesh().and_then(|mesh| meshes.get(mesh)) else { continue };
        let Ok(Some(names)) = mesh.try_morph_target_names() else { continue };
        let found = LipzShapes::find(names, bank, &face.rig).unwrap_or_else(|error| {
            commands.trigger(LipzFailed { entity, error });
            LipzShapes::unknown(bank, &face.rig)
        });
        commands.entity(entity).insert(found);
    }
}

/// Sets the weights of all recognised morph targets.
pub(crate) fn move_faces(faces: Faces, mut models: Query<(Entity, &mut MorphWeights, &mut LipzShapes)>) {
    for (entity, mut weights, mut shapes) in &mut models {
        let shapes = shapes.bypass_change_detection();
        let parts = faces.of(entity);
        let shown =
            parts.as_ref().and_then(|FaceParts { player, bank, .. }| player.state.line.as_ref()?.pose(bank.bank()));
        let (Some(FaceParts { face, player, mouth, bank }), Some((clip, time))) = (parts, shown) else {
            if !shapes.is_resting {
                shapes.is_resting = true;
                shapes.rest(|shape, weight| set(&mut weights, shape, weight));
            }
            continue;
        };
        shapes.is_resting = false;
        let (who, speaks) = who(&player.speaker, &face.character);
        let write = |shape, weight| set(&mut weights, shape, weight);
        shapes.compute((bank.bank(), &clip, time), speaks.then_some(mouth), who, write);
    }
}

/// Returns the character of a face, and whether it speaks.
fn who<'a>(speaker: &'a str, character: &'a str) -> (Who<'a>, bool) {
    match (speaker, character) {
        ("", "") => (Who::Speaker, true),
        (speaker, "") => (Who::SpeakerNamed(speaker), true),
        (speaker, character) if speaker == character => (Who::SpeakerNamed(speaker), true),
        (_, character) => (Who::Other(character), false),
    }
}

/// Sets one weight. An equal one does not count as changed, so that it is not uploaded again.
fn set(weights: &mut Mut<MorphWeights>, shape: usize, weight: f32) {
    if weights.weights().get(shape).is_some_and(|old| *old != weight)
        && let Some(place) = weights.weights_mut().get_mut(shape)
    {
        *place = weight;
    }
}
