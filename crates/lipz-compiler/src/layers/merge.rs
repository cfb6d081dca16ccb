//! One bank of a stack.

use super::content::{Draft, Records, Texts};
use super::stack::MAX_LAYERS;
use crate::lower::Beside;
use lipz_bank::{Bank, LayeredClip, LayeredLocale, Layers};
use lipz_diagnostics::Report;
use lipz_layout::Tag;
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};

type Locale<'d> = LayeredLocale<'d, MAX_LAYERS>;

/// The bank that is packed from the sources of all layers in one go. Source records are lost if one of them has none.
pub(super) fn merge(layers: &Layers<'_, MAX_LAYERS>) -> Result<Vec<u8>, Report> {
    let tags: BTreeSet<&str> = layers.locale_tags().collect();
    let locales: Vec<Locale<'_>> = tags.into_iter().filter_map(|tag| layers.locale(tag)).collect();
    let is_used = used(layers, &locales);
    let locales: Vec<Locale<'_>> =
        std::iter::zip(locales, is_used).filter(|(_, is_used)| *is_used).map(|(locale, _)| locale).collect();
    let default = layers.default_locale();
    let mut draft =
        Draft::new(locales.iter().map(|locale| (locale.tag().to_owned(), default == Some(locale.tag()))).collect());
    let records: Vec<Records<'_>> =
        (0..layers.layer_count()).filter_map(|layer| layers.bank(layer).map(Records::of)).collect();
    let strip = records.iter().any(Records::are_stripped);
    let mut recordings = BTreeMap::new();
    for clip in layers.clips() {
        let texts = texts(&clip, &locales);
        // A record is with what is topmost of its clip.
        let (_, record) = [(clip.layer(), Some(*clip.clip())), (clip.texts_layer().unwrap_or(0), clip.texts())]
            .into_iter()
            .filter_map(|(layer, clip)| Some((layer, records.get(layer)?.get(&clip?))))
            .max_by_key(|(layer, _)| *layer)
            .unwrap_or_default();
        draft.push(clip.key(), Some(clip.clip()), Some(&texts), clip.segment_count(), if strip { &[] } else { record });
        recordings.extend(clip.recording().map(|recording| (clip.key().to_owned(), recording)));
    }
    draft.bank(Beside {
        strip,
        babble: layers.of_babble().map_or(&[][..], |bank| profiles(bank, Tag::BABBLE)).to_vec(),
        faces: layers.of_faces().map_or(&[][..], |bank| profiles(bank, Tag::FACES)).to_vec(),
        recordings: Cow::Owned(recordings),
        layer: None,
    })
}

/// The texts of a clip of a stack.
fn texts<'d>(clip: &LayeredClip<'d, '_>, locales: &[Locale<'d>]) -> Texts<'d> {
    Texts::new(locales.len(), clip.segment_count(), |locale, segment| clip.text(segment, &locales[locale]))
}

/// For each locale whether a clip has a text in it, and not only that of another locale.
fn used(layers: &Layers<'_, MAX_LAYERS>, locales: &[Locale<'_>]) -> Vec<bool> {
    let mut is_used = vec![false; locales.len()];
    for clip in layers.clips() {
        let unknown: Vec<usize> = (0..locales.len()).filter(|&locale| !is_used[locale]).collect();
        if unknown.is_empty() {
            break;
        }
        let is_own = |locale: &usize| clip.text(0, &locales[*locale]).is_some_and(|text| !text.is_fallback());
        if unknown.iter().all(is_own) {
            unknown.iter().for_each(|&locale| is_used[locale] = true);
            continue;
        }
        let texts = texts(&clip, locales);
        unknown.iter().for_each(|&locale| is_used[locale] |= texts.has_own(locale));
    }
    is_used
}

/// A section of profiles; empty if the bank has none.
pub(super) fn profiles<'d>(bank: &Bank<'d>, tag: Tag) -> &'d [u8] {
    bank.sections().find(|(of, _)| *of == tag.0).map_or(&[], |(_, bytes)| bytes)
}
