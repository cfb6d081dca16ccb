//! One bank of a stack.

use super::content::{Draft, Records, Texts};
use super::links::{Whose, dubs_of};
use super::stack::MAX_LAYERS;
use crate::localise::LocaleColumn;
use crate::lower::Beside;
use lipz_bank::{Bank, LayeredClip, LayeredLocale, Layers, TextBank};
use lipz_diagnostics::{Code, Report};
use lipz_layout::Tag;
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};

type Locale<'d> = LayeredLocale<'d, MAX_LAYERS>;

/// The bank that is packed from the sources of all layers in one go. Source records are lost if one of them has none.
pub(super) fn merge(layers: &Layers<'_, MAX_LAYERS>) -> Result<Vec<u8>, Report> {
    merge_of(layers, &[], &|_| true)
}

/// A bank with the texts of its text banks.
pub(crate) fn joined<'d>(bank: &Bank<'d>, texts: &[TextBank<'d>]) -> Result<Vec<u8>, Report> {
    let layers = Layers::from_slice(std::slice::from_ref(bank)).map_err(|_| not_whole())?;
    merge_of(&layers, texts, &|_| true)
}

fn not_whole() -> Report {
    let help = "name the banks below it, too: `base.lipzbank+layer.lipzbank`";
    Report::failure("", Code::LayerMisfit, "a layer alone is no bank", help)
}

/// The same of the clips that `keeps` chooses: with a dub, its original. `texts` are those of the banks.
pub(super) fn merge_of<'d>(
    layers: &Layers<'d, MAX_LAYERS>,
    texts: &[TextBank<'d>],
    keeps: &dyn Fn(&LayeredClip<'_, '_>) -> bool,
) -> Result<Vec<u8>, Report> {
    let all: Vec<LayeredClip<'_, '_>> = layers.clips().collect();
    let clips: Vec<LayeredClip<'_, '_>> = all.iter().copied().filter(keeps).collect();
    let of_texts = || texts.iter().flat_map(TextBank::locales);
    let tags: BTreeSet<&str> = layers.locale_tags().chain(of_texts().map(|locale| locale.tag())).collect();
    let locales: Vec<Locale<'_>> = tags.into_iter().filter_map(|tag| layers.locale_in(tag, texts)).collect();
    // Of all clips, so that banks of voices have the locales of the whole bank: fallback goes by clip.
    let is_used = used(&all, &locales);
    let locales: Vec<Locale<'_>> =
        std::iter::zip(locales, is_used).filter(|(_, is_used)| *is_used).map(|(locale, _)| locale).collect();
    let default = layers.default_locale().or_else(|| Some(of_texts().find(lipz_bank::Locale::is_default)?.tag()));
    let column = |locale: &Locale<'_>| LocaleColumn::new(locale.tag(), default == Some(locale.tag()));
    let mut draft = Draft::new(locales.iter().map(column).collect());
    let records: Vec<Records<'_>> =
        (0..layers.layer_count()).filter_map(|layer| layers.bank(layer).map(Records::of)).collect();
    let strip = records.iter().any(Records::are_stripped);
    draft.dubs = dubs_of(layers, &clips);
    let tags: Vec<&str> = locales.iter().map(LayeredLocale::tag).collect();
    let mut recordings = BTreeMap::new();
    for clip in clips {
        let shown = self::texts(&clip, &locales);
        let whose = match clip.original(layers) {
            Some(original) => {
                let theirs = self::texts(&original, &locales);
                Whose::Some(Whose::of_layered(&clip, layers, &tags, (&shown, &theirs)))
            }
            None => Whose::Some(Vec::new()),
        };
        // A record is with what is topmost of its clip.
        let in_layer = |layer: usize| Some((layer, layers.bank(layer)?.clip(clip.id())?));
        let topmost = (0..layers.layer_count()).rev().find_map(in_layer);
        let record = topmost.and_then(|(layer, clip)| Some(records.get(layer)?.get(&clip))).unwrap_or_default();
        let record = if strip { &[] } else { record };
        draft.push(clip.key(), Some(clip.clip()), Some((&shown, &whose)), clip.segment_count(), record);
        recordings.extend(clip.recording().map(|recording| (clip.key().to_owned(), recording)));
    }
    draft.bank(Beside {
        strip,
        babble: layers.of_babble().map_or(&[][..], |bank| profiles(bank, Tag::BABBLE)).to_vec(),
        faces: layers.of_faces().map_or(&[][..], |bank| profiles(bank, Tag::FACES)).to_vec(),
        recordings: Cow::Owned(recordings),
        layer: None,
        export: Vec::new(),
    })
}

/// The texts of a clip of a stack.
fn texts<'d>(clip: &LayeredClip<'d, '_>, locales: &[Locale<'d>]) -> Texts<'d> {
    Texts::new(locales.len(), clip.segment_count(), |locale, segment| clip.text(segment, &locales[locale]))
}

/// For each locale whether a clip has a text in it, and not only that of another locale.
fn used(clips: &[LayeredClip<'_, '_>], locales: &[Locale<'_>]) -> Vec<bool> {
    let mut is_used = vec![false; locales.len()];
    for clip in clips {
        let unknown: Vec<usize> = (0..locales.len()).filter(|&locale| !is_used[locale]).collect();
        if unknown.is_empty() {
            break;
        }
        let is_own = |locale: &usize| clip.text(0, &locales[*locale]).is_some_and(|text| !text.is_fallback());
        if unknown.iter().all(is_own) {
            unknown.iter().for_each(|&locale| is_used[locale] = true);
            continue;
        }
        let texts = texts(clip, locales);
        unknown.iter().for_each(|&locale| is_used[locale] |= texts.has_own(locale));
    }
    is_used
}

/// A section of profiles; empty if the bank has none.
pub(super) fn profiles<'d>(bank: &Bank<'d>, tag: Tag) -> &'d [u8] {
    bank.sections().find(|(of, _)| *of == tag.0).map_or(&[], |(_, bytes)| bytes)
}
