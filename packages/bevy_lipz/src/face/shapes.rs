//! The morph targets that a face moves, and where their weights come from.

use super::names::ModelNames;
use crate::{LipzError, LipzMouth};
use bevy::ecs::component::Component;
use lipz_bank::articulation::{Articulation, Rig};
use lipz_bank::curve::CurveValue;
use lipz_bank::face::{LookAt, Who};
use lipz_bank::{Bank, Clip, VisemeType};
use std::time::Duration;

/// The recognised morph targets of an entity with `MorphWeights`. A [`LipzFace`](super::LipzFace) adds it.
#[derive(Component, Clone, Debug)]
pub struct LipzShapes {
    kind: Kind,
    /// For each recognised morph target, the index of its weight, and its own index.
    map: Vec<(usize, usize)>,
    missing: Vec<String>,
    /// The version of the bank, and the rig that the face names.
    checksum: u64,
    wanted: String,
    /// Room for the weights of the rig.
    weights: Vec<CurveValue>,
    pub(super) is_resting: bool,
}

/// The source of the weights.
#[derive(Clone, PartialEq, Eq, Debug)]
enum Kind {
    Rig(String),
    Visemes(VisemeType),
    Unknown,
}

impl LipzShapes {
    /// Returns the name of the rig, or of the viseme type, that the morph targets have the names of; `None` if they
    /// are unknown.
    pub fn kind(&self) -> Option<&str> {
        match &self.kind {
            Kind::Rig(name) => Some(name),
            Kind::Visemes(viseme_type) => Some(viseme_type.name()),
            Kind::Unknown => None,
        }
    }

    /// Returns the weights for which the model does not have a morph target. A model with several meshes often has
    /// them in a different one.
    pub fn missing(&self) -> &[String] {
        &self.missing
    }

    /// Recognises the morph targets of a model. If `wanted` names a rig of the bank, only its weights count.
    pub(super) fn find(names: &[String], bank: &Bank<'_>, wanted: &str) -> Result<LipzShapes, LipzError> {
        let model = ModelNames::new(names);
        let rigs = bank.rigs().filter(|rig| wanted.is_empty() || rig.name() == wanted);
        let rigs = rigs.map(|rig| {
            let weights: Vec<_> = rig.weight_names().map(str::to_owned).collect();
            Candidate::new(Kind::Rig(rig.name().to_owned()), rig.name(), weights, &model)
        });
        let types = VisemeType::ALL.into_iter().filter(|_| wanted.is_empty()).map(|kind| {
            let weights = kind.codes().chars().map(String::from).collect();
            Candidate::new(Kind::Visemes(kind), kind.name(), weights, &model)
        });
        // The first of equal ones. Letters are also names of other shapes, so most visemes must have one.
        let types = types.filter(|found| found.map.len() * 2 > found.weights.len());
        let best = rigs.chain(types).fold(None, |best: Option<Candidate>, other| match best {
            Some(best) if best.map.len() >= other.map.len() => Some(best),
            _ => Some(other),
        });
        match best {
            None if !wanted.is_empty() => Err(LipzError::NoRig { name: wanted.to_owned() }),
            Some(best) if !best.map.is_empty() => Ok(best.shapes(bank, wanted)),
            _ => Err(LipzError::NoShapes { names: names.to_vec() }),
        }
    }

    /// Returns shapes that never move, for a model without known names.
    pub(super) fn unknown(bank: &Bank<'_>, wanted: &str) -> LipzShapes {
        Candidate { kind: Kind::Unknown, weights: Vec::new(), map: Vec::new() }.shapes(bank, wanted)
    }

    /// Whether the bank or the face has changed.
    pub(super) fn is_outdated(&self, bank: &Bank<'_>, wanted: &str) -> bool {
        self.checksum != bank.checksum() || self.wanted != wanted
    }

    /// Computes the weights of a character at a time, and passes those of the morph targets to `set`.
    pub(super) fn compute(
        &mut self,
        (bank, clip, time): (&Bank<'_>, &Clip<'_>, Duration),
        mouth: Option<&LipzMouth>,
        who: Who<'_>,
        mut set: impl FnMut(usize, f32),
    ) {
        match &self.kind {
            Kind::Rig(name) => {
                let Some(rig) = bank.rig(name) else { return };
                pose(&rig, (bank, clip, time), mouth.is_some(), who, &mut self.weights);
                for (weight, shape) in &self.map {
                    set(*shape, self.weights.get(*weight).map_or(0.0, |weight| weight.to_f32()));
                }
            }
            Kind::Visemes(kind) => {
                let is_of_clip = clip.viseme_type() == Some(*kind);
                let shown = mouth.filter(|_| is_of_clip).map_or('-', |mouth| mouth.viseme);
                for (weight, shape) in &self.map {
                    let is_shown = kind.codes().chars().nth(*weight) == Some(shown);
                    set(*shape, if is_shown { 1.0 } else { 0.0 });
                }
            }
            Kind::Unknown => {}
        }
    }

    /// Passes 0 for each of the morph targets to `set`.
    pub(super) fn rest(&self, mut set: impl FnMut(usize, f32)) {
        for (_, shape) in &self.map {
            set(*shape, 0.0);
        }
    }
}

/// Stores the weights of a rig for a character who speaks, or listens.
fn pose(
    rig: &Rig<'_>,
    (bank, clip, time): (&Bank<'_>, &Clip<'_>, Duration),
    speaks: bool,
    who: Who<'_>,
    out: &mut [CurveValue],
) {
    let mouth = if speaks { clip.articulation_at(time, &bank.default_articulation()) } else { Articulation::default() };
    let face = clip.face_at(time, who, &bank.default_face_profile(), LookAt::AHEAD);
    rig.weights(&mouth, &clip.emotions_at(time, who), &face, out);
}

/// A rig or a viseme type, with the morph targets of a model that have its names.
struct Candidate {
    kind: Kind,
    weights: Vec<String>,
    map: Vec<(usize, usize)>,
}

impl Candidate {
    fn new(kind: Kind, name: &str, weights: Vec<String>, model: &ModelNames) -> Candidate {
        let found = weights.iter().enumerate();
        let map = found.filter_map(|(index, weight)| Some((index, model.find(name, weight)?))).collect();
        Candidate { kind, weights, map }
    }

    fn shapes(self, bank: &Bank<'_>, wanted: &str) -> LipzShapes {
        let Candidate { kind, weights, map } = self;
        let room = vec![CurveValue::default(); weights.len()];
        let is_missing = |index: &usize| map.iter().all(|(found, _)| found != index);
        let missing = weights.into_iter().enumerate().filter(|(index, _)| is_missing(index));
        LipzShapes {
            missing: missing.map(|(_, name)| name).collect(),
            kind,
            map,
            checksum: bank.checksum(),
            wanted: wanted.to_owned(),
            weights: room,
            is_resting: true,
        }
    }
}
