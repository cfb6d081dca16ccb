//! The weights of a rig while a clip plays, for exports and for curves in banks.

use crate::bank::lower::{BankExtras, Layout};
use crate::clip::{ClipData, Clips, Key};
use crate::locales::dubs::Dubs;
use crate::locales::localise;
use crate::project::Options;
use crate::project::rigs::{self, RigSettings};
use lipz_bank::articulation::{ArticulationProfile, Rig};
use lipz_bank::curve::CurveValue;
use lipz_bank::face::{FaceProfile, LookAt, Who};
use lipz_bank::{Bank, Clip, Micros};
use lipz_file::curve;
use std::collections::BTreeMap;

/// The largest distance of a baked curve from the weight that it replaces, in thousandths: a hundredth, which is less
/// than an eye sees.
const BAKED_TOLERANCE: i32 = 10;

/// The weights of a rig at any time of a clip.
///
/// A curve of the clip that has the name of a weight replaces it.
#[derive(Clone, Debug)]
pub struct ClipWeights<'b> {
    clip: Clip<'b>,
    rig: Rig<'b>,
    articulation: ArticulationProfile<'b>,
    face: FaceProfile<'b>,
}

impl<'b> ClipWeights<'b> {
    /// Returns the weights of a rig for a clip of a bank, with the bank's own profiles.
    pub fn new(bank: &Bank<'b>, clip: Clip<'b>, rig: Rig<'b>) -> ClipWeights<'b> {
        let (articulation, face) = (bank.default_articulation(), bank.default_face_profile());
        ClipWeights { clip, rig, articulation, face }
    }

    /// Returns the names of the weights, in the order of [`at`](Self::at).
    pub fn names(&self) -> impl Iterator<Item = &'b str> {
        self.rig.weight_names()
    }

    /// Returns the weights at a time.
    pub fn at(&self, time: Micros) -> Vec<CurveValue> {
        let mouth = self.clip.articulation_at(time, &self.articulation);
        let emotions = self.clip.emotions_at(time, Who::Speaker);
        let face = self.clip.face_at(time, Who::Speaker, &self.face, LookAt::AHEAD);
        let mut weights = vec![CurveValue::default(); self.rig.weight_count()];
        self.rig.weights(&mouth, &emotions, &face, &mut weights);
        for (name, weight) in self.names().zip(&mut weights) {
            let own = self.clip.curve(name).and_then(|curve| curve.value_at(time));
            *weight = own.unwrap_or(*weight);
        }
        weights
    }
}

/// Adds the weights of the rig that the project bakes to the clip as curves, at its frames. Curves of the file with the
/// same names stay. Weights that are always 0 get no curve.
pub(crate) fn bake(key: &str, clip: &mut ClipData, options: &Options) {
    let Some((name, weights)) = &options.baked_rig else { return };
    let (Some(fps), false) = (clip.fps, clip.frames.is_empty()) else { return };
    let rigs = RigSettings::from([(name.clone(), weights.clone())]);
    let Some(bytes) = bank_of_clip(key, clip, &rigs, options) else { return };
    let Ok(bank) = Bank::open(&bytes) else { return };
    let (Some(in_bank), Some(rig)) = (bank.clip_by_key(key), bank.rig(name)) else { return };
    let weights = ClipWeights::new(&bank, in_bank, rig);
    let mut samples: Vec<Vec<CurveValue>> = vec![Vec::with_capacity(clip.frames.len()); rig.weight_count()];
    for frame in 0..clip.frames.len() as u32 {
        let time = Micros(i64::try_from(fps.start_of_frame_us(frame)).unwrap_or(i64::MAX));
        samples.iter_mut().zip(weights.at(time)).for_each(|(samples, weight)| samples.push(weight));
    }
    let named = weights.names().zip(samples);
    let moving = named.filter(|(_, samples)| samples.iter().any(|sample| sample.thousandths() != 0));
    let own: Vec<&str> = clip.curves.iter().map(|(name, _)| name).collect();
    let curves: BTreeMap<String, Vec<Key>> = moving
        .filter(|(name, _)| !own.contains(name))
        .map(|(name, samples)| (name.to_owned(), curve::sampled(&samples, BAKED_TOLERANCE)))
        .collect();
    clip.curves.add_missing(curves);
}

/// Returns a bank with the movement of a clip, and with these rigs.
fn bank_of_clip(key: &str, clip: &ClipData, rigs: &RigSettings, options: &Options) -> Option<Vec<u8>> {
    let mut moving = ClipData {
        fps: clip.fps,
        viseme_type: clip.viseme_type,
        has_visemes: clip.has_visemes,
        frames: clip.frames.clone(),
        starts: vec![0],
        phones: clip.phones.clone(),
        ..ClipData::default()
    };
    clip.curves.iter().for_each(|(name, keys)| moving.curves.push(name, keys.iter().copied()));
    let mut clips = Clips::default();
    clips.push(key, &moving);
    let batches = vec![clips];
    let extras = BankExtras { strip: true, rigs: rigs::section(rigs), ..BankExtras::of(options) };
    let layout = Layout::new(&Clips::by_key(&batches), &localise::own(&[], options), &Dubs::default(), extras).ok()?;
    layout.fill(batches).ok()
}
