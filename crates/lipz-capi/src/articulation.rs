//! Articulation: how far jaw, lips and tongue are from rest, and the weights of a model's shapes.

use crate::clip::{Clip, of_clip};
use crate::dialogue::{Dialogue, of_project, reader};
use crate::face::{Emotions, Face};
use crate::handle::{LIPZ_BUILT_IN, profile_named};
use crate::pointer::{answer, text, zeros};
use crate::status::{LIPZ_NONE, LIPZ_NULL_POINTER, LIPZ_OK, Status};
use crate::string::{String, c_char};
use crate::time::Time;
use core::mem::MaybeUninit;
use lipz_bank::articulation::Rig as ReaderRig;

/// Articulator: how far the jaw is lowered, as an index of `thousandths`.
pub const LIPZ_JAW: u32 = 0;
/// Articulator: how far the lips are apart, whatever the jaw does.
pub const LIPZ_OPENING: u32 = 1;
/// Articulator: how firmly the lips are closed, as in *p*, *b* and *m*.
pub const LIPZ_CLOSURE: u32 = 2;
/// Articulator: how far the lower lip is under the upper teeth, as in *f* and *v*.
pub const LIPZ_TEETH: u32 = 3;
/// Articulator: how far the lips are rounded and pushed forward.
pub const LIPZ_ROUNDING: u32 = 4;
/// Articulator: how far the corners of the lips are pulled apart.
pub const LIPZ_SPREADING: u32 = 5;
/// Articulator: how far the tip of the tongue is raised.
pub const LIPZ_TONGUE_TIP: u32 = 6;
/// Articulator: how far the tongue is between the teeth.
pub const LIPZ_TONGUE_OUT: u32 = 7;
/// Articulator: how far the back of the tongue is raised.
pub const LIPZ_TONGUE_BACK: u32 = 8;
/// The number of articulators.
pub const LIPZ_ARTICULATOR_COUNT: usize = 9;

/// How far jaw, lips and tongue are from rest at a time.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct Articulation {
    /// Values in thousandths, from 0 to 1,000: `thousandths[LIPZ_JAW]`.
    pub thousandths: [u16; LIPZ_ARTICULATOR_COUNT],
}

/// An articulation profile of a dialogue. Look it up once; queries use `index` and `version`.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct ArticulationProfile {
    /// Its name: `default` for the project's profile.
    pub name: String,
    /// Its index among the profiles, or `LIPZ_BUILT_IN`.
    pub index: u32,
    /// The version of the dialogue.
    pub version: u32,
}

/// A rig of a dialogue: the shapes of a model. Look it up once; queries use `index` and `version`.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct Rig {
    /// Its name: `arkit`.
    pub name: String,
    /// Its index among the rigs.
    pub index: u32,
    /// The version of the dialogue.
    pub version: u32,
    /// The number of its weights.
    pub weight_count: u32,
    /// 0.
    pub reserved: u32,
}

/// Writes the articulation profile with this name. If `name` is null, writes the project's profile (`[articulation]` in
/// its settings), or the default one if the project has none.
#[no_mangle]
pub unsafe extern "C" fn lipz_dialogue_articulation_profile(
    dialogue: Option<&Dialogue>,
    name: *const c_char,
    name_length_bytes: usize,
    profile: Option<&mut MaybeUninit<ArticulationProfile>>,
) -> Status {
    answer(profile, || {
        // SAFETY: the contract of the crate, which the caller keeps.
        let dialogue = unsafe { reader(dialogue) }?;
        let names = dialogue.articulations().map(|profile| profile.name());
        let built_in = lipz_bank::articulation::ArticulationProfile::DEFAULT.name();
        // SAFETY: the same contract.
        let (name, index) = unsafe { profile_named(dialogue, name, name_length_bytes, names, built_in) }?;
        Ok(ArticulationProfile { name, index, version: dialogue.version() })
    })
}

/// Writes the articulation of a clip at a time, computed from its phones, or from its visemes if it has no phones.
/// Curves of the clip override computed values. A null `profile` stands for the project's. `LIPZ_NONE` for a profile of
/// another version.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_articulation_at(
    dialogue: Option<&Dialogue>,
    clip: Option<&Clip>,
    time: Time,
    profile: Option<&ArticulationProfile>,
    articulation: Option<&mut MaybeUninit<Articulation>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe {
        of_clip(dialogue, clip, articulation, |dialogue, clip| {
            let profile = match profile {
                None => of_project(dialogue, Some(dialogue.default_articulation()))?,
                Some(profile) if profile.index == LIPZ_BUILT_IN => {
                    lipz_bank::articulation::ArticulationProfile::DEFAULT
                }
                Some(profile) if profile.version != dialogue.version() => return Err(LIPZ_NONE),
                Some(profile) => dialogue.articulations().nth(profile.index as usize).ok_or(LIPZ_NONE)?,
            };
            Ok(Articulation { thousandths: *clip.articulation_at(time.to_reader(), &profile).values() })
        })
    }
}

/// Writes the rig with this name. `LIPZ_NONE` if the project's settings do not name it in `[rig]`.
#[no_mangle]
pub unsafe extern "C" fn lipz_dialogue_rig(
    dialogue: Option<&Dialogue>,
    name: *const c_char,
    name_length_bytes: usize,
    rig: Option<&mut MaybeUninit<Rig>>,
) -> Status {
    answer(rig, || {
        // SAFETY: the contract of the crate, which the caller keeps.
        let (dialogue, name) = unsafe { (reader(dialogue)?, text(name, name_length_bytes)?) };
        let found = (0..).zip(dialogue.rigs()).find(|(_, rig)| rig.name() == name);
        let (index, rig) = of_project(dialogue, found)?;
        let weight_count = u32::try_from(rig.weight_count()).unwrap_or(u32::MAX);
        Ok(Rig { name: String::from_text(rig.name()), index, version: dialogue.version(), weight_count, reserved: 0 })
    })
}

/// Writes the name of a weight of a rig. `LIPZ_NONE` for an index from `weight_count` on.
#[no_mangle]
pub unsafe extern "C" fn lipz_rig_weight_name(
    dialogue: Option<&Dialogue>,
    rig: Option<&Rig>,
    index: u32,
    name: Option<&mut MaybeUninit<String>>,
) -> Status {
    answer(name, || {
        // SAFETY: the contract of the crate, which the caller keeps.
        let rig = rig_of(unsafe { reader(dialogue) }?, rig)?;
        let is_known = (index as usize) < rig.weight_count();
        if is_known { Ok(String::from_text(rig.weight_name(index as usize))) } else { Err(LIPZ_NONE) }
    })
}

/// Writes the weights of a rig in thousandths, in the order of their names, to `thousandths`, and zeros from the last one
/// to `capacity`. Null `emotions` and a null `face` stand for a neutral face.
#[no_mangle]
pub unsafe extern "C" fn lipz_rig_weights(
    dialogue: Option<&Dialogue>,
    rig: Option<&Rig>,
    articulation: Option<&Articulation>,
    emotions: Option<&Emotions>,
    face: Option<&Face>,
    thousandths: *mut i32,
    capacity: usize,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    let weights = match unsafe { zeros(thousandths, capacity) } {
        Ok(weights) => weights,
        Err(status) => return status,
    };
    // SAFETY: the same contract.
    let rig = unsafe { reader(dialogue) }.and_then(|dialogue| rig_of(dialogue, rig));
    match (rig, articulation) {
        (Ok(rig), Some(articulation)) => {
            let mouth = lipz_bank::articulation::Articulation::from_thousandths(articulation.thousandths);
            let emotions = emotions.copied().map_or_else(Default::default, Emotions::to_reader);
            rig.weights(&mouth, &emotions, &face.copied().map_or_else(Default::default, Face::to_reader), weights);
            LIPZ_OK
        }
        (Ok(_), None) => LIPZ_NULL_POINTER,
        (Err(status), _) => status,
    }
}

/// Returns the caller's rig.
fn rig_of<'a>(dialogue: &lipz_bank::Dialogue<'a>, rig: Option<&Rig>) -> Result<ReaderRig<'a>, Status> {
    match rig {
        None => Err(LIPZ_NULL_POINTER),
        Some(rig) if rig.version != dialogue.version() => Err(LIPZ_NONE),
        Some(rig) => dialogue.rigs().nth(rig.index as usize).ok_or(LIPZ_NONE),
    }
}
