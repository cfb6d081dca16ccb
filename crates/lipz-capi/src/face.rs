//! Faces: emotions, and generated motion of lids, head and eyes. Angles are in thousandths of a degree: pitch is
//! positive upwards, yaw to the left of the character, roll towards the left shoulder.

use crate::clip::{Clip, of_clip};
use crate::dialogue::{Dialogue, of_project, reader};
use crate::handle::{LIPZ_BUILT_IN, profile_named};
use crate::pointer::answer;
use crate::status::{LIPZ_NONE, Status};
use crate::string::{String, c_char};
use crate::time::Time;
use crate::who::{self, Who};
use core::mem::MaybeUninit;
use lipz_bank::curve::CurveValue;

/// Attribute of emotion: `sadness`, as an index of `thousandths`.
pub const LIPZ_SADNESS: u32 = 0;
/// Attribute of emotion: `anger`.
pub const LIPZ_ANGER: u32 = 1;
/// Attribute of emotion: `joy`.
pub const LIPZ_JOY: u32 = 2;
/// Attribute of emotion: `fear`.
pub const LIPZ_FEAR: u32 = 3;
/// Attribute of emotion: `disgust`.
pub const LIPZ_DISGUST: u32 = 4;
/// Attribute of emotion: `surprise`.
pub const LIPZ_SURPRISE: u32 = 5;
/// Attribute of emotion: `shock`.
pub const LIPZ_SHOCK: u32 = 6;
/// Attribute of emotion: `perplexed`.
pub const LIPZ_PERPLEXED: u32 = 7;
/// Attribute of emotion: `asleep`.
pub const LIPZ_ASLEEP: u32 = 8;
/// Attribute of emotion: `pain`.
pub const LIPZ_PAIN: u32 = 9;
/// Attribute of emotion: `exertion`.
pub const LIPZ_EXERTION: u32 = 10;
/// Attribute of emotion: `shout`.
pub const LIPZ_SHOUT: u32 = 11;
/// The number of attributes of emotion.
pub const LIPZ_EMOTION_COUNT: usize = 12;
/// The value of `strongest` for a neutral face.
pub const LIPZ_NEUTRAL: u32 = 0xFFFF_FFFF;

/// The emotions of a character: all zeros for a neutral face.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Emotions {
    /// Values in thousandths, from 0 to 10,000 unless the file exceeds this range: `thousandths[LIPZ_ANGER]`.
    pub thousandths: [i32; LIPZ_EMOTION_COUNT],
    /// The attribute with the highest value, `LIPZ_NEUTRAL` if none is above 0.
    pub strongest: u32,
    /// The sum of all values, in thousandths.
    pub sum: i32,
}

impl Default for Emotions {
    fn default() -> Emotions {
        Emotions { thousandths: [0; LIPZ_EMOTION_COUNT], strongest: LIPZ_NEUTRAL, sum: 0 }
    }
}

impl Emotions {
    pub(crate) fn to_reader(self) -> lipz_bank::face::Emotions {
        lipz_bank::face::Emotions::new(self.thousandths.map(CurveValue::from_thousandths))
    }
}

/// A face profile of a dialogue. Look it up once; queries use `index` and `version`.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct FaceProfile {
    /// Its name: `default` for the project's profile.
    pub name: String,
    /// Its index among the profiles, or `LIPZ_BUILT_IN`.
    pub index: u32,
    /// The version of the dialogue.
    pub version: u32,
}

/// The target of a character's eyes: a direction, relative to the head at rest.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct LookAt {
    /// How far up it is.
    pub pitch: i32,
    /// How far to the left of the character it is.
    pub yaw: i32,
    /// 1 for a person, at whose face, hands and body the eyes look; 0 for a target on which they stay.
    pub is_person: u32,
}

/// The state of a face at a time, except mouth and emotions. Numbers are in thousandths.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct Face {
    /// How far the lids are closed, from 0 to 1,000.
    pub blink: i32,
    /// How far the head is raised.
    pub head_pitch: i32,
    /// How far the head is turned.
    pub head_yaw: i32,
    /// How far the head is tilted.
    pub head_roll: i32,
    /// How far the eyes are raised in the head.
    pub eye_pitch: i32,
    /// How far the eyes are turned in the head.
    pub eye_yaw: i32,
    /// How far the brows are raised, from 0 to 1,000. Only curves raise them.
    pub brows: i32,
    /// A shrug of the face, from 0 to 1,000. Only curves set it.
    pub shrug: i32,
    /// How hard the character breathes, from 0 to 10,000. Only curves set it.
    pub breath: i32,
}

/// Writes the emotions of a character of a clip at a time, or the speaker's if `who` is null. Neutral without curves,
/// and without a frame rate.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_emotions_at(
    dialogue: Option<&Dialogue>,
    clip: Option<&Clip>,
    time: Time,
    who: Option<&Who>,
    emotions: Option<&mut MaybeUninit<Emotions>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe {
        of_clip(dialogue, clip, emotions, |_, clip| {
            let who = who::to_reader(who)?;
            let found = clip.emotions_at(time.to_reader(), who);
            let mut emotions = Emotions { sum: found.sum().thousandths(), ..Emotions::default() };
            for (place, (_, value)) in emotions.thousandths.iter_mut().zip(found.iter()) {
                *place = value.thousandths();
            }
            if let Some((strongest, _)) = found.strongest() {
                emotions.strongest = strongest as u32;
            }
            Ok(emotions)
        })
    }
}

/// Writes the face profile with this name. If `name` is null, writes the project's profile (`[face]` in its settings),
/// or the default one if the project has none.
#[no_mangle]
pub unsafe extern "C" fn lipz_dialogue_face_profile(
    dialogue: Option<&Dialogue>,
    name: *const c_char,
    name_length_bytes: usize,
    profile: Option<&mut MaybeUninit<FaceProfile>>,
) -> Status {
    answer(profile, || {
        // SAFETY: the contract of the crate, which the caller keeps.
        let dialogue = unsafe { reader(dialogue) }?;
        let (names, built_in) =
            (dialogue.face_profiles().map(|profile| profile.name()), lipz_bank::face::FaceProfile::DEFAULT.name());
        // SAFETY: the same contract.
        let (name, index) = unsafe { profile_named(dialogue, name, name_length_bytes, names, built_in) }?;
        Ok(FaceProfile { name, index, version: dialogue.version() })
    })
}

/// Writes the face of a character of a clip at a time, generated from `profile`, or the speaker's if `who` is null.
/// Curves of the clip override generated values. A null `profile` stands for the project's, and a null `look_at` for a
/// person straight ahead. `LIPZ_NONE` for a profile of another version.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_face_at(
    dialogue: Option<&Dialogue>,
    clip: Option<&Clip>,
    time: Time,
    who: Option<&Who>,
    profile: Option<&FaceProfile>,
    look_at: Option<&LookAt>,
    face: Option<&mut MaybeUninit<Face>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe {
        of_clip(dialogue, clip, face, |dialogue, clip| {
            let (who, profile) = (who::to_reader(who)?, profile_of(dialogue, profile)?);
            Ok(Face::from_reader(clip.face_at(time.to_reader(), who, &profile, looked_at(look_at))))
        })
    }
}

/// Writes the face of a silent character, who blinks and looks. `time` may start anywhere. Give each character a
/// different `seed`, so that they do not blink at the same time. The other arguments are those of `lipz_clip_face_at`.
#[no_mangle]
pub unsafe extern "C" fn lipz_face_idle_at(
    dialogue: Option<&Dialogue>,
    time: Time,
    seed: u64,
    profile: Option<&FaceProfile>,
    look_at: Option<&LookAt>,
    face: Option<&mut MaybeUninit<Face>>,
) -> Status {
    answer(face, || {
        // SAFETY: the contract of the crate, which the caller keeps.
        let profile = profile_of(unsafe { reader(dialogue) }?, profile)?;
        Ok(Face::from_reader(profile.idle_at(time.to_reader(), seed, looked_at(look_at))))
    })
}

impl Face {
    pub(crate) fn to_reader(self) -> lipz_bank::face::Face {
        let mut face = lipz_bank::face::Face::default();
        face.blink = CurveValue::from_thousandths(self.blink);
        face.brows = CurveValue::from_thousandths(self.brows);
        face.shrug = CurveValue::from_thousandths(self.shrug);
        face
    }

    fn from_reader(face: lipz_bank::face::Face) -> Face {
        Face {
            blink: face.blink.thousandths(),
            head_pitch: face.head_pitch.thousandths(),
            head_yaw: face.head_yaw.thousandths(),
            head_roll: face.head_roll.thousandths(),
            eye_pitch: face.eye_pitch.thousandths(),
            eye_yaw: face.eye_yaw.thousandths(),
            brows: face.brows.thousandths(),
            shrug: face.shrug.thousandths(),
            breath: face.breath.thousandths(),
        }
    }
}

/// Returns the caller's profile.
fn profile_of<'a>(
    dialogue: &lipz_bank::Dialogue<'a>,
    profile: Option<&FaceProfile>,
) -> Result<lipz_bank::face::FaceProfile<'a>, Status> {
    match profile {
        None => of_project(dialogue, Some(dialogue.default_face_profile())),
        Some(profile) if profile.index == LIPZ_BUILT_IN => Ok(lipz_bank::face::FaceProfile::DEFAULT),
        Some(profile) if profile.version != dialogue.version() => Err(LIPZ_NONE),
        Some(profile) => dialogue.face_profiles().nth(profile.index as usize).ok_or(LIPZ_NONE),
    }
}

/// Returns the caller's target of the eyes.
fn looked_at(look_at: Option<&LookAt>) -> lipz_bank::face::LookAt {
    let value = CurveValue::from_thousandths;
    match look_at {
        None => lipz_bank::face::LookAt::AHEAD,
        Some(look) if look.is_person == 0 => lipz_bank::face::LookAt::point(value(look.pitch), value(look.yaw)),
        Some(look) => lipz_bank::face::LookAt::person(value(look.pitch), value(look.yaw)),
    }
}
