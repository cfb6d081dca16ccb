//! A bank and the layers over it: which of them answers.
//!
//! C keeps the banks of a stack in an array, the base first. These functions say in which of them a clip, a text and a locale
//! are; all else is asked of that bank.

use crate::bank::{Bank, Opened, opened, opened_with_texts};
use crate::clip::Clip;
use crate::layered_voice::Array;
use crate::locale::Locale;
use crate::pointer::{answer, text};
use crate::segment::Text;
use crate::status::{LIPZ_NONE, LIPZ_NULL_POINTER, LIPZ_OK, Status, of_damage};
use crate::string::{String, c_char};
use core::mem::MaybeUninit;
use lipz_bank::{ClipId, ErrorKind, original_of};

/// In place of a layer: there is none.
pub const LIPZ_NO_LAYER: u32 = u32::MAX;

/// A clip of a stack. Ask the bank `banks[layer]` about `clip`: mouths, segments, events, curves, a cursor. Texts are those of
/// `lipz_layers_text`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct LayeredClip {
    /// The clip in its own bank.
    pub clip: Clip,
    /// Index of that bank.
    pub layer: u32,
    /// Index of the bank that has the texts; `LIPZ_NO_LAYER` if none has any.
    pub texts_layer: u32,
    /// The id that the clip with the texts has there: that of this clip, or of its original, if it is a dub.
    pub texts_id: u64,
}

impl Default for LayeredClip {
    fn default() -> LayeredClip {
        LayeredClip { clip: Clip::default(), layer: LIPZ_NO_LAYER, texts_layer: LIPZ_NO_LAYER, texts_id: 0 }
    }
}

/// A locale of a stack in one of its banks.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct LayeredLocale {
    /// The locale of that bank whose texts show.
    pub locale: Locale,
    /// 1 if it is another locale, which stands in for the one that was asked for.
    pub is_stand_in: u32,
}

/// Which banks of a stack say what is said once.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct LayersInfo {
    /// Index of the bank whose babble profiles count.
    pub babble_layer: u32,
    /// Index of the bank whose default locale counts.
    pub default_locale_layer: u32,
    /// Index of the bank whose face profiles count.
    pub faces_layer: u32,
}

/// Checks that `count` opened banks make a stack, the base first: that each layer was made over banks below it. Call it once,
/// after opening them, and verify each bank by itself.
///
/// The status is that of a bank: error 37 for a layer of other banks. `misfit` may be null; otherwise it gets the index of the bank
/// that does not fit, and 0 if all do.
#[no_mangle]
pub unsafe extern "C" fn lipz_layers_check(
    banks: *const Bank,
    count: u32,
    misfit: Option<&mut MaybeUninit<u32>>,
) -> Status {
    let place = misfit.map(|misfit| misfit.write(0));
    if count == 0 {
        return Status::from(ErrorKind::LayerCount.number());
    }
    for at in 0..count {
        // SAFETY: the contract of the crate, which the caller keeps.
        if let Err(status) = unsafe { fits(banks, at) } {
            if let Some(place) = place {
                *place = at;
            }
            return status;
        }
    }
    LIPZ_OK
}

/// The clip with this id, of the topmost bank that has it; `LIPZ_NONE` if none does, or one above removes it.
#[no_mangle]
pub unsafe extern "C" fn lipz_layers_clip_by_id(
    banks: *const Bank,
    count: u32,
    id: u64,
    clip: Option<&mut MaybeUninit<LayeredClip>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    answer(clip, || unsafe { find(banks, count, ClipId::from_u64(id)) })
}

/// The clip with this key, compared whole.
#[no_mangle]
pub unsafe extern "C" fn lipz_layers_clip_by_key(
    banks: *const Bank,
    count: u32,
    key: *const c_char,
    key_length_bytes: usize,
    clip: Option<&mut MaybeUninit<LayeredClip>>,
) -> Status {
    answer(clip, || {
        // SAFETY: the contract of the crate, which the caller keeps.
        unsafe {
            let key = text(key, key_length_bytes)?;
            let found = find(banks, count, ClipId::from_key(key))?;
            let bank = opened(bank_at(banks, found.layer))?;
            let has_key = bank.clip_at(found.clip.slot).map_or(false, |clip| clip.key() == key);
            if has_key { Ok(found) } else { Err(LIPZ_NONE) }
        }
    })
}

/// The locale with this tag as the bank with the index `layer` has it, or what stands in for it there. Look it up once for each
/// bank. `LIPZ_NONE` if clips of this bank have no texts in it.
#[no_mangle]
pub unsafe extern "C" fn lipz_layers_locale(
    banks: *const Bank,
    count: u32,
    layer: u32,
    tag: *const c_char,
    tag_length_bytes: usize,
    locale: Option<&mut MaybeUninit<LayeredLocale>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    answer(locale, || unsafe { locale_in(banks, count, layer, text(tag, tag_length_bytes)?) })
}

/// The text of the segment with this index of a clip, in a locale that was looked up for its `texts_layer`. `LIPZ_NONE` if the
/// clip has none, also by fallback.
#[no_mangle]
pub unsafe extern "C" fn lipz_layers_text(
    banks: *const Bank,
    count: u32,
    clip: Option<&LayeredClip>,
    segment: u32,
    locale: Option<&LayeredLocale>,
    text: Option<&mut MaybeUninit<Text>>,
) -> Status {
    answer(text, || {
        let (clip, layered) = clip.zip(locale).ok_or(LIPZ_NULL_POINTER)?;
        if clip.texts_layer >= count {
            return Err(LIPZ_NONE);
        }
        // SAFETY: the contract of the crate, which the caller keeps.
        let opened = unsafe { opened_with_texts(bank_at(banks, clip.texts_layer)) }?;
        let locale = layered.locale.find(&opened).ok_or(LIPZ_NONE)?;
        let found = opened.bank.clip(ClipId::from_u64(clip.texts_id)).and_then(|clip| clip.segment(segment));
        let text = found.and_then(|segment| segment.text(locale)).ok_or(LIPZ_NONE)?;
        let is_fallback = (text.is_fallback() || layered.is_stand_in != 0).into();
        Ok(Text { data: text.as_ptr().cast(), length_bytes: text.len(), is_fallback })
    })
}

/// Which banks say what is said once for the whole stack.
#[no_mangle]
pub unsafe extern "C" fn lipz_layers_info(
    banks: *const Bank,
    count: u32,
    info: Option<&mut MaybeUninit<LayersInfo>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    answer(info, || unsafe { self::info(banks, count) })
}

/// # Safety
/// As [`find`].
pub(crate) unsafe fn info(banks: *const Bank, count: u32) -> Result<LayersInfo, Status> {
    let mut info = LayersInfo::default();
    for at in 0..count {
        // SAFETY: the same contract.
        if let Some(layer) = unsafe { opened(bank_at(banks, at)) }?.layer() {
            info.babble_layer = if layer.has_babble() { at } else { info.babble_layer };
            info.default_locale_layer = if layer.has_default_locale() { at } else { info.default_locale_layer };
            info.faces_layer = if layer.has_faces() { at } else { info.faces_layer };
        }
    }
    Ok(info)
}

/// A bank of the array.
///
/// # Safety
/// `banks` is null or leads to more banks than `at`.
pub(crate) unsafe fn bank_at<'data>(banks: *const Bank, at: u32) -> Option<&'data Bank> {
    if banks.is_null() {
        return None;
    }
    // SAFETY: the same contract.
    unsafe { banks.add(at as usize).as_ref() }
}

/// Whether the bank at `at` fits those below it.
///
/// # Safety
/// As [`bank_at`].
unsafe fn fits(banks: *const Bank, at: u32) -> Result<(), Status> {
    let damage = |kind: ErrorKind| Status::from(kind.number());
    // SAFETY: the same contract.
    let bank = unsafe { opened(bank_at(banks, at)) }?;
    let layer = match bank.verified_layer().map_err(of_damage)? {
        Some(layer) => layer,
        None if at == 0 => return Ok(()),
        None => return Err(damage(ErrorKind::NotALayer)),
    };
    let mut below = 0..at;
    for base in layer.made_over() {
        loop {
            let next = below.next().ok_or(damage(ErrorKind::OtherBase))?;
            // SAFETY: the same contract.
            if unsafe { opened(bank_at(banks, next)) }?.checksum() == base {
                break;
            }
        }
    }
    Ok(())
}

/// The clip with this id in the topmost bank that has it.
///
/// # Safety
/// `banks` is null or leads to `count` banks.
pub(crate) unsafe fn find(banks: *const Bank, count: u32, id: ClipId) -> Result<LayeredClip, Status> {
    let mut found = LayeredClip { texts_id: id.get(), ..LayeredClip::default() };
    let mut has_texts_of_original = false;
    for at in (0..count).rev() {
        // SAFETY: the same contract.
        let bank = unsafe { opened(bank_at(banks, at)) }?;
        let layer = bank.layer();
        let clip = match bank.clip(id) {
            Some(clip) => clip,
            None if layer.map_or(false, |layer| layer.removes(id)) => break,
            None => continue,
        };
        let (has_clip, has_texts) = layer.map_or((true, true), |layer| layer.parts(clip.slot()));
        if !has_texts_of_original && found.texts_layer == LIPZ_NO_LAYER {
            has_texts_of_original = layer.map_or(false, |layer| layer.has_texts_of_original(clip.slot()));
            found.texts_layer = if has_texts { at } else { LIPZ_NO_LAYER };
        }
        if has_clip && found.layer == LIPZ_NO_LAYER {
            found.layer = at;
            found.clip = Clip::from_found(Some(clip))?;
        }
        if found.layer != LIPZ_NO_LAYER && (has_texts_of_original || found.texts_layer != LIPZ_NO_LAYER) {
            break;
        }
    }
    if found.layer == LIPZ_NO_LAYER {
        return Err(LIPZ_NONE);
    }
    if has_texts_of_original {
        if let Some((_, original)) = original_of(&Array { banks, count }, id) {
            // SAFETY: the same contract.
            found.texts_layer = unsafe { own_texts(banks, count, original) }?;
            found.texts_id = original.get();
        }
    }
    Ok(found)
}

/// The bank that has the texts of the clip with this id, if they are its own.
///
/// # Safety
/// As [`find`].
unsafe fn own_texts(banks: *const Bank, count: u32, id: ClipId) -> Result<u32, Status> {
    for at in (0..count).rev() {
        // SAFETY: the same contract.
        let bank = unsafe { opened(bank_at(banks, at)) }?;
        let layer = bank.layer();
        match bank.clip(id) {
            Some(clip) if layer.map_or(true, |layer| layer.parts(clip.slot()).1) => return Ok(at),
            Some(clip) if layer.map_or(false, |layer| layer.has_texts_of_original(clip.slot())) => break,
            None if layer.map_or(false, |layer| layer.removes(id)) => break,
            _ => {}
        }
    }
    Ok(LIPZ_NO_LAYER)
}

/// The locale with this tag in the bank at `layer`.
///
/// # Safety
/// As [`find`].
unsafe fn locale_in(banks: *const Bank, count: u32, layer: u32, tag: &str) -> Result<LayeredLocale, Status> {
    let mut stand_in: Option<&str> = None;
    let mut is_removed = false;
    for at in (layer..count).rev() {
        // SAFETY: the same contract.
        let opened = unsafe { opened_with_texts(bank_at(banks, at)) }?;
        let about = opened.bank.layer();
        let found = if is_removed { None } else { numbered(&opened, tag) };
        if at == layer {
            return match (found, stand_in) {
                (Some(locale), _) => Ok(LayeredLocale { locale, is_stand_in: 0 }),
                (None, Some(other)) => {
                    numbered(&opened, other).map(|locale| LayeredLocale { locale, is_stand_in: 1 }).ok_or(LIPZ_NONE)
                }
                (None, None) => Err(LIPZ_NONE),
            };
        }
        // What stands in for a locale of this bank in those below it.
        let below = |tag: &str| {
            let place = opened.bank.locales().position(|locale| locale.tag() == tag)?;
            let place = about.and_then(|layer| layer.stand_in(place))?;
            opened.bank.locales().nth(place).map(|locale| locale.tag())
        };
        stand_in = match found {
            Some(_) => below(tag),
            // What this bank brought itself has another one below it.
            None => stand_in.and_then(below).or(stand_in),
        };
        let removes = |tag: &str| about.as_ref().map_or(false, |layer| layer.removes_locale(tag));
        is_removed |= removes(tag);
        // Nothing of that counts below: it is another locale with the same tag, which came later.
        stand_in = stand_in.filter(|other| !removes(other));
    }
    Err(LIPZ_NONE)
}

/// The locale of a bank with this tag.
fn numbered(opened: &Opened<'_>, tag: &str) -> Option<Locale> {
    let (index, locale) = (0..).zip(opened.locales()).find(|(_, locale)| locale.tag() == tag)?;
    let is_default = locale.is_default().into();
    Some(Locale { tag: String::from_text(locale.tag()), index, is_default, bank: opened.origin() })
}
