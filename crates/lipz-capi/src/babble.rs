//! Babble: mouth movement without visemes.

use crate::dialogue::{Dialogue, reader};
use crate::handle::{LIPZ_BUILT_IN, profile_named};
use crate::pointer::answer;
use crate::status::{LIPZ_NONE, LIPZ_NULL_POINTER, Status};
use crate::string::{String, c_char};
use crate::time::Time;
use core::mem::MaybeUninit;
use lipz_bank::babble::{Power, VoiceLevel};

/// The level for a voice that the program does not measure: three quarters. At this level all digits of the viewer's
/// profile show, but not at their widest.
pub const LIPZ_UNMEASURED: u32 = 0xC000;

/// A babble profile of a dialogue. Look it up once; queries use `index` and `version`.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct Babble {
    /// Its name: `default` for the project's profile.
    pub name: String,
    /// Its index among the profiles, or `LIPZ_BUILT_IN`.
    pub index: u32,
    /// The version of the dialogue.
    pub version: u32,
}

/// The weights of the two mouth movements of babble.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct Weights {
    /// How far the lips are pursed, in ten-thousandths.
    pub ooh: u32,
    /// How far the jaw is open, in ten-thousandths.
    pub aah: u32,
}

/// Writes the babble profile with this name. If `name` is null, writes the project's profile (`[babble]` in its
/// settings), or the viewer's own if the project has none.
#[no_mangle]
pub unsafe extern "C" fn lipz_dialogue_babble(
    dialogue: Option<&Dialogue>,
    name: *const c_char,
    name_length_bytes: usize,
    babble: Option<&mut MaybeUninit<Babble>>,
) -> Status {
    answer(babble, || {
        // SAFETY: the contract of the crate, which the caller keeps.
        let dialogue = unsafe { reader(dialogue) }?;
        let (names, built_in) =
            (dialogue.babbles().map(|profile| profile.name()), lipz_bank::babble::Babble::DEFAULT.name());
        // SAFETY: the same contract.
        let (name, index) = unsafe { profile_named(dialogue, name, name_length_bytes, names, built_in) }?;
        Ok(Babble { name, index, version: dialogue.version() })
    })
}

/// Writes how far lips and jaw have moved at a time since the start of speech, at a `power` of the voice from 0 to 1.
/// All zeros before 0. `LIPZ_NONE` for a profile of another version.
#[no_mangle]
pub unsafe extern "C" fn lipz_babble_at(
    dialogue: Option<&Dialogue>,
    babble: Option<&Babble>,
    time: Time,
    power: f32,
    weights: Option<&mut MaybeUninit<Weights>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { babbled(dialogue, babble, time, power, weights) }
}

/// `lipz_babble_at` without floating point: `level` is the power in 65,536ths, at most 65,535, or `LIPZ_UNMEASURED`.
#[no_mangle]
pub unsafe extern "C" fn lipz_babble_at_level(
    dialogue: Option<&Dialogue>,
    babble: Option<&Babble>,
    time: Time,
    level: u32,
    weights: Option<&mut MaybeUninit<Weights>>,
) -> Status {
    let level = VoiceLevel(u16::try_from(level).unwrap_or(u16::MAX));
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { babbled(dialogue, babble, time, level, weights) }
}

/// Computes the weights of the profile at this time.
///
/// # Safety
/// The contract of the crate.
unsafe fn babbled(
    dialogue: Option<&Dialogue>,
    babble: Option<&Babble>,
    time: Time,
    power: impl Power,
    out: Option<&mut MaybeUninit<Weights>>,
) -> Status {
    answer(out, || {
        // SAFETY: the same contract.
        let dialogue = unsafe { reader(dialogue) }?;
        let babble = babble.ok_or(LIPZ_NULL_POINTER)?;
        let profile = match babble.index {
            LIPZ_BUILT_IN => Some(lipz_bank::babble::Babble::DEFAULT),
            index => dialogue.babbles().nth(index as usize).filter(|_| babble.version == dialogue.version()),
        };
        let profile = profile.ok_or(LIPZ_NONE)?;
        let weights = profile.at(time.to_reader(), power);
        Ok(Weights { ooh: weights.ooh.ten_thousandths().into(), aah: weights.aah.ten_thousandths().into() })
    })
}
