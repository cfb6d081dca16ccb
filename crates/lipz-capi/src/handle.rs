//! Values that are looked up once and passed to queries: locales, voices and names.

use crate::dialogue::{Dialogue, not_found, of_project, reader};
use crate::pointer::{answer, text};
use crate::status::{LIPZ_NONE, LIPZ_NULL_POINTER, Status};
use crate::string::{String, c_char};
use core::mem::MaybeUninit;

/// The `index` of a profile that needs no file: the Second Life viewer's own for babble, the default one for faces.
pub const LIPZ_BUILT_IN: u32 = 0xFFFF_FFFF;
/// The `bank` of a missing name.
pub const LIPZ_NO_NAME: u32 = 0;

/// A locale of a dialogue. In another version of the dialogue it leads to `LIPZ_NONE`: look it up again.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct Locale {
    /// Its tag, as in `text_en-us` of a Lipz file: `en-us`.
    pub tag: String,
    /// The version of the dialogue.
    pub version: u32,
    /// Its position in the dialogue.
    pub place: u32,
    /// 1 for the default locale.
    pub is_default: u32,
}

/// A voice: a language in which lines are recorded. In another version of the dialogue it leads to the clip itself:
/// look it up again.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct Voice {
    /// The locale of the voice: `de-de`.
    pub tag: String,
    /// The version of the dialogue.
    pub version: u32,
    /// Its position in the dialogue.
    pub place: u32,
    /// 1 for the voice of the original recordings, in which no clip is a dub.
    pub is_original: u32,
}

/// A name in events: a character, an emotion, a target or an action. Equal names have equal strings.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct Name {
    /// The name as spelled in the Lipz file.
    pub name: String,
    /// Identifies the bank of the name; `LIPZ_NO_NAME` for a missing name.
    pub bank: u32,
    /// Its number in that bank.
    pub id: u32,
}

impl Locale {
    fn from_reader(dialogue: &lipz_bank::Dialogue<'_>, locale: lipz_bank::Locale) -> Locale {
        let [version, place] = locale.to_words();
        let is_default = (dialogue.default_locale() == Some(locale)).into();
        Locale { tag: String::from_text(dialogue.locale_tag(locale)), version, place, is_default }
    }

    pub(crate) fn to_reader(self) -> lipz_bank::Locale {
        lipz_bank::Locale::from_words([self.version, self.place])
    }
}

impl Voice {
    pub(crate) fn from_reader(dialogue: &lipz_bank::Dialogue<'_>, voice: lipz_bank::Voice) -> Voice {
        let [version, place] = voice.to_words();
        let tag = String::from_text(dialogue.voice_tag(voice));
        Voice { tag, version, place, is_original: voice.is_original().into() }
    }

    pub(crate) fn to_reader(self) -> lipz_bank::Voice {
        lipz_bank::Voice::from_words([self.version, self.place])
    }
}

impl Name {
    pub(crate) fn from_reader(name: Option<lipz_bank::EventName<'_>>) -> Name {
        name.map_or_else(Name::default, |name| {
            let [bank, id] = name.to_words();
            Name { name: String::from_text(name.as_str()), bank, id }
        })
    }
}

/// Returns the profile with this name among `names`, with its index. If the name is null, returns the project's
/// profile, or the built-in one.
///
/// # Safety
/// The contract of the crate.
pub(crate) unsafe fn profile_named<'n>(
    dialogue: &lipz_bank::Dialogue<'_>,
    name: *const c_char,
    name_length_bytes: usize,
    names: impl Iterator<Item = &'n str>,
    built_in: &'n str,
) -> Result<(String, u32), Status> {
    // SAFETY: the same contract.
    let asked = if name.is_null() { "default" } else { unsafe { text(name, name_length_bytes) }? };
    match (0..).zip(names).find(|(_, name)| *name == asked) {
        Some((index, found)) => Ok((String::from_text(found), index)),
        None => {
            let built_in = of_project(dialogue, Some(built_in).filter(|_| name.is_null()))?;
            Ok((String::from_text(built_in), LIPZ_BUILT_IN))
        }
    }
}

/// Writes the locale with this tag, spelled as in the files, or the default locale if `tag` is null. `LIPZ_ABSENT` if
/// no bank of a set is loaded.
#[no_mangle]
pub unsafe extern "C" fn lipz_dialogue_locale(
    dialogue: Option<&Dialogue>,
    tag: *const c_char,
    tag_length_bytes: usize,
    locale: Option<&mut MaybeUninit<Locale>>,
) -> Status {
    answer(locale, || {
        // SAFETY: the contract of the crate, which the caller keeps.
        let dialogue = unsafe { reader(dialogue) }?;
        let found = match tag.is_null() {
            true => dialogue.default_locale(),
            // SAFETY: the same contract.
            false => dialogue.locale(unsafe { text(tag, tag_length_bytes) }?),
        };
        of_project(dialogue, found.map(|locale| Locale::from_reader(dialogue, locale)))
    })
}

/// Writes the locale with this index. Call it from 0 on until `LIPZ_NONE`.
#[no_mangle]
pub unsafe extern "C" fn lipz_dialogue_locale_by_index(
    dialogue: Option<&Dialogue>,
    index: u32,
    locale: Option<&mut MaybeUninit<Locale>>,
) -> Status {
    answer(locale, || {
        // SAFETY: the contract of the crate, which the caller keeps.
        let dialogue = unsafe { reader(dialogue) }?;
        Ok(Locale::from_reader(dialogue, dialogue.locales().nth(index as usize).ok_or(LIPZ_NONE)?))
    })
}

/// Writes the locale for texts of a variant: for `pl-pl` and the key `few`, the texts of `text_pl-pl-x-few` in Lipz
/// files. A key lists all cases that apply, the plural category first: `few`, or `few-fem`. The search removes names
/// from the end of the key (`few-fem`, `few`), and then does the same without the plural category (`fem`). If no clip
/// has any of these, the answer is the locale itself. Look variants up once per locale.
#[no_mangle]
pub unsafe extern "C" fn lipz_dialogue_variant(
    dialogue: Option<&Dialogue>,
    locale: Option<&Locale>,
    key: *const c_char,
    key_length_bytes: usize,
    variant: Option<&mut MaybeUninit<Locale>>,
) -> Status {
    answer(variant, || {
        // SAFETY: the contract of the crate, which the caller keeps.
        let (dialogue, key) = unsafe { (reader(dialogue)?, text(key, key_length_bytes)?) };
        let locale = locale.ok_or(LIPZ_NULL_POINTER)?.to_reader();
        Ok(Locale::from_reader(dialogue, dialogue.variant(locale, key)))
    })
}

/// Writes the voice in this locale, spelled as in the files. `LIPZ_NONE` if there are no dubs, or if the project does
/// not define this voice: play the clips unchanged. `LIPZ_ABSENT` if it is not found while a bank of a set is missing,
/// because a bank without dubs lists no voices.
#[no_mangle]
pub unsafe extern "C" fn lipz_dialogue_voice(
    dialogue: Option<&Dialogue>,
    tag: *const c_char,
    tag_length_bytes: usize,
    voice: Option<&mut MaybeUninit<Voice>>,
) -> Status {
    answer(voice, || {
        // SAFETY: the contract of the crate, which the caller keeps.
        let (dialogue, tag) = unsafe { (reader(dialogue)?, text(tag, tag_length_bytes)?) };
        let found = dialogue.voice(tag).map(|voice| Voice::from_reader(dialogue, voice));
        found.ok_or_else(|| not_found(dialogue))
    })
}

/// Writes the voice with this index, that of the originals first. Call it from 0 on until `LIPZ_NONE`.
#[no_mangle]
pub unsafe extern "C" fn lipz_dialogue_voice_by_index(
    dialogue: Option<&Dialogue>,
    index: u32,
    voice: Option<&mut MaybeUninit<Voice>>,
) -> Status {
    answer(voice, || {
        // SAFETY: the contract of the crate, which the caller keeps.
        let dialogue = unsafe { reader(dialogue) }?;
        Ok(Voice::from_reader(dialogue, dialogue.voices().nth(index as usize).ok_or(LIPZ_NONE)?))
    })
}

/// Writes the name as spelled in events, for the speaker of a cursor. In a set, only loaded banks are searched.
#[no_mangle]
pub unsafe extern "C" fn lipz_dialogue_event_name(
    dialogue: Option<&Dialogue>,
    name: *const c_char,
    name_length_bytes: usize,
    found: Option<&mut MaybeUninit<Name>>,
) -> Status {
    answer(found, || {
        // SAFETY: the contract of the crate, which the caller keeps.
        let (dialogue, name) = unsafe { (reader(dialogue)?, text(name, name_length_bytes)?) };
        Ok(Name::from_reader(Some(dialogue.event_name(name).ok_or(LIPZ_NONE)?)))
    })
}
