//! Merging a dialogue into one bank.

use super::content::{Draft, Records, ShownTexts};
use super::links::{TextOwner, dubs_of};
use crate::bank::dialogue::{self, TaggedLocale, bank_of_profiles, banks, clips_by_key, locales_by_tag};
use crate::bank::lower::BankExtras;
use crate::locales::localise::LocaleColumn;
use lipz_bank::{Bank, Clip, Dialogue};
use lipz_diagnostics::Report;
use lipz_layout::Tag;
use std::borrow::Cow;
use std::collections::BTreeMap;

/// Returns the bank that packing the sources of all files together would make. Without source records, if a bank lacks
/// them.
pub(super) fn merge(dialogue: &Dialogue<'_>) -> Result<Vec<u8>, Report> {
    merge_of(dialogue, &|_| true)
}

/// Returns the bank of the clips that `keeps` selects, including the originals of dubs.
pub(super) fn merge_of<'d>(dialogue: &'d Dialogue<'d>, keeps: &dyn Fn(&Clip<'_>) -> bool) -> Result<Vec<u8>, Report> {
    let all = clips_by_key(dialogue);
    let locales = locales_by_tag(dialogue);
    // Use all clips, so that banks of voices have the locales of the whole bank, because fallback is decided per clip.
    let has_text_banks = dialogue::texts_bytes(dialogue) > 0;
    let texts = |clip: &Clip<'d>, locales: &[TaggedLocale<'_>]| {
        let texts = texts(clip, locales);
        if has_text_banks { texts.without_copies() } else { texts }
    };
    let is_used = used(&all, &locales, &texts);
    let locales: Vec<TaggedLocale<'_>> =
        std::iter::zip(locales, is_used).filter(|(_, is_used)| *is_used).map(|(locale, _)| locale).collect();
    let column = |locale: &TaggedLocale<'_>| LocaleColumn::new(locale.tag, locale.is_default);
    let mut draft = Draft::new(locales.iter().map(column).collect());
    let records: BTreeMap<usize, Records<'_>> =
        banks(dialogue).map(|(number, bank)| (number, Records::of(bank))).collect();
    let strip = records.values().any(Records::are_stripped);
    let clips: Vec<Clip<'_>> = all.into_iter().filter(keeps).collect();
    draft.dubs = dubs_of(dialogue, &clips);
    let mut recordings = BTreeMap::new();
    for clip in &clips {
        let shown = texts(clip, &locales);
        let whose = TextOwner::of_dialogue(clip, dialogue, &locales);
        let record = || {
            let (number, topmost) = dialogue::topmost(dialogue, clip)?;
            Some(records.get(&number)?.get(&topmost))
        };
        let record = if strip { &[] } else { record().unwrap_or_default() };
        draft.push(clip.key(), Some(clip), Some((&shown, &whose)), clip.segment_count(), record);
        recordings.extend(clip.recording().map(|recording| (clip.key().to_owned(), recording)));
    }
    let of = |tag| bank_of_profiles(dialogue, tag).map_or(&[][..], |bank| profiles(bank, tag)).to_vec();
    draft.bank(BankExtras {
        strip,
        babble: of(Tag::BABBLE),
        faces: of(Tag::FACES),
        articulation: of(Tag::ARTICULATION),
        rigs: of(Tag::RIGS),
        recordings: Cow::Owned(recordings),
        layer: None,
        export: Vec::new(),
    })
}

/// Returns the texts of a clip of a dialogue.
fn texts<'d>(clip: &Clip<'d>, locales: &[TaggedLocale<'_>]) -> ShownTexts<'d> {
    let text = |locale: usize, segment| clip.segment(segment)?.text(locales[locale].locale);
    ShownTexts::new(locales.len(), clip.segment_count(), text)
}

/// Returns for each locale whether a clip has a text of its own in it.
fn used<'d>(
    clips: &[Clip<'d>],
    locales: &[TaggedLocale<'_>],
    texts: &dyn Fn(&Clip<'d>, &[TaggedLocale<'_>]) -> ShownTexts<'d>,
) -> Vec<bool> {
    let mut is_used = vec![false; locales.len()];
    for clip in clips {
        let unknown: Vec<usize> = (0..locales.len()).filter(|&locale| !is_used[locale]).collect();
        if unknown.is_empty() {
            break;
        }
        let segment = clip.segment(0);
        let is_own =
            |locale: &usize| segment.as_ref().is_some_and(|segment| segment.has_own_text(locales[*locale].locale));
        if unknown.iter().all(is_own) {
            unknown.iter().for_each(|&locale| is_used[locale] = true);
            continue;
        }
        let texts = texts(clip, locales);
        unknown.iter().for_each(|&locale| is_used[locale] |= texts.has_own(locale));
    }
    is_used
}

/// Returns a section of profiles; empty if the bank has none.
pub(super) fn profiles<'d>(bank: &Bank<'d>, tag: Tag) -> &'d [u8] {
    bank.sections().find(|(of, _)| *of == tag.0).map_or(&[], |(_, bytes)| bytes)
}
