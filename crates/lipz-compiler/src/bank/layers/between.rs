//! Computing the layer that turns one whole bank into another.

use super::content::{Draft, Records, ShownText, ShownTexts, are_equal};
use super::links::{Links, TextOwner};
use super::merge::profiles;
use crate::bank::lower::BankExtras;
use crate::bank::lower::layer::LayerDraft;
use crate::locales::localise::LocaleColumn;
use lipz_bank::{Bank, Clip, Locale};
use lipz_diagnostics::Report;
use lipz_layout::{
    LAYER_ARTICULATION, LAYER_BABBLE, LAYER_DEFAULT_LOCALE, LAYER_FACES, LAYER_RIGS, LAYER_VOICES, NO_STAND_IN,
    PART_CLIP, PART_ORIGINAL, PART_TEXTS, Tag,
};
use std::borrow::Cow;
use std::collections::{BTreeMap, HashMap};

/// The locales of the new bank, and the old locales with their texts.
struct Pairs {
    old: Vec<Locale>,
    new: Vec<Locale>,
    /// The number among the new locales for each old one.
    old_to_new: Vec<Option<usize>>,
    /// For each new locale, the old one with the same tag or its stand-in, and whether it is a stand-in.
    sources: Vec<Option<(usize, bool)>>,
}

/// Returns the layer that turns `old` into `new`, for a stack that equals `old` and has banks with these checksums;
/// `None` if there is no difference. Both banks are verified, and neither is a layer.
pub(crate) fn between(old: &Bank<'_>, new: &Bank<'_>, checksums: &[u64]) -> Result<Option<Vec<u8>>, Report> {
    let pairs = Pairs::new(old, new);
    let records = [Records::of(old), Records::of(new)];
    let default = |bank: &Bank<'_>| bank.default_locale().map(|locale| bank.locale_tag(locale).to_owned());
    let column = |locale: &Locale| LocaleColumn::new(new.locale_tag(*locale), new.default_locale() == Some(*locale));
    let mut draft = Draft::new(pairs.new.iter().map(column).collect());
    let mut layer = LayerDraft { bases: checksums.to_vec(), ..LayerDraft::default() };
    let mut recordings = BTreeMap::new();
    for clip in new.clips() {
        let (texts, whose) = (ShownTexts::of(&clip, &pairs.new), TextOwner::of(&clip, &pairs.new));
        let parts = match old.clip_by_key(clip.key()) {
            Some(before) => {
                let has_record = records[0].get(&before) == records[1].get(&clip);
                changed(&before, &clip, (&texts, &whose), &pairs, has_record)
            }
            None => PART_CLIP | PART_TEXTS,
        };
        if parts == 0 {
            continue;
        }
        let has = |part| parts & part != 0;
        let all_own = TextOwner::Some(Vec::new());
        let texts = (has(PART_TEXTS) && whose != TextOwner::Original).then_some((&texts, &all_own));
        let parts = if has(PART_TEXTS) && texts.is_none() { parts ^ PART_TEXTS | PART_ORIGINAL } else { parts };
        let of_clip = has(PART_CLIP).then_some(&clip);
        if let (Some(_), TextOwner::Some(borrowed)) = (&texts, &whose) {
            let locales = borrowed.iter().enumerate().filter(|(_, is_borrowed)| **is_borrowed);
            layer.borrowed.extend(locales.map(|(locale, _)| (layer.parts.len(), locale)));
        }
        draft.push(clip.key(), of_clip, texts, clip.segment_count(), records[1].get(&clip));
        recordings.extend(clip.recording().filter(|_| has(PART_CLIP)).map(|found| (clip.key().to_owned(), found)));
        layer.parts.push(parts);
    }
    let removed = old.clips().filter(|clip| new.clip_by_key(clip.key()).is_none());
    layer.removed = removed.map(|clip| clip.id().get()).collect();
    layer.removed.sort_unstable();
    let gone = std::iter::zip(&pairs.old, &pairs.old_to_new).filter(|(_, new)| new.is_none());
    layer.removed_locales = gone.map(|(locale, _)| old.locale_tag(*locale).to_owned()).collect();
    if pairs.sources.iter().any(|source| source.is_none_or(|(_, stands_in)| stands_in)) {
        layer.stand_ins = pairs.stand_ins();
    }
    let new_profiles = |tag| Some(profiles(new, tag)).filter(|new| *new != profiles(old, tag));
    let (babble, faces) = (new_profiles(Tag::BABBLE), new_profiles(Tag::FACES));
    let (articulation, rigs) = (new_profiles(Tag::ARTICULATION), new_profiles(Tag::RIGS));
    let has_default = default(old) != default(new);
    let links = Links::between(old, new);
    let has = [
        (babble.is_some(), LAYER_BABBLE),
        (faces.is_some(), LAYER_FACES),
        (articulation.is_some(), LAYER_ARTICULATION),
        (rigs.is_some(), LAYER_RIGS),
        (has_default, LAYER_DEFAULT_LOCALE),
        (links.are_all, LAYER_VOICES),
    ];
    (layer.dubs, layer.voices) = (links.records, links.voices);
    layer.flags = has.into_iter().filter(|(has, _)| *has).fold(0, |flags, (_, flag)| flags | flag);
    let is_empty = layer.parts.is_empty() && layer.removed.is_empty() && layer.removed_locales.is_empty();
    if is_empty && layer.stand_ins.is_empty() && layer.voices.is_empty() && layer.flags == 0 {
        return Ok(None);
    }
    let beside = BankExtras {
        strip: records[1].are_stripped(),
        babble: babble.unwrap_or_default().to_vec(),
        faces: faces.unwrap_or_default().to_vec(),
        articulation: articulation.unwrap_or_default().to_vec(),
        rigs: rigs.unwrap_or_default().to_vec(),
        recordings: Cow::Owned(recordings),
        layer: Some(layer),
        export: Vec::new(),
    };
    draft.bank(beside).map(Some)
}

/// Returns the parts of a clip that the layer must contain.
fn changed(
    before: &Clip<'_>,
    clip: &Clip<'_>,
    (texts, whose): (&ShownTexts<'_>, &TextOwner),
    pairs: &Pairs,
    has_record: bool,
) -> u8 {
    let is_same = are_equal(before, clip);
    let same_texts = before.segment_count() == clip.segment_count() && {
        let (before, was) = (ShownTexts::of(before, &pairs.old), TextOwner::of(before, &pairs.old));
        let is_as_much = |locale: usize| match pairs.sources[locale] {
            Some((source, false)) => {
                texts.shown[locale] != ShownText::Own || was.is_original(source) == whose.is_original(locale)
            }
            _ => true,
        };
        (was == TextOwner::Original) == (*whose == TextOwner::Original)
            && (0..pairs.new.len()).all(|locale| pairs.shows_the_same(&before, texts, locale) && is_as_much(locale))
    };
    match (is_same, same_texts) {
        // A changed spelling of the file needs a part to accompany.
        (true, true) if !has_record => PART_CLIP | PART_TEXTS,
        (true, true) => 0,
        (false, true) => PART_CLIP,
        (true, false) => PART_TEXTS,
        (false, false) => PART_CLIP | PART_TEXTS,
    }
}

impl Pairs {
    fn new(old: &Bank<'_>, new: &Bank<'_>) -> Pairs {
        let (old_locales, new_locales): (Vec<_>, Vec<_>) = (old.locales().collect(), new.locales().collect());
        // Locales are sorted by tag.
        let tags = |bank: &Bank<'_>| bank.locales().map(|locale| bank.locale_tag(locale).to_owned()).collect();
        let (old_tags, new_tags): (Vec<String>, Vec<String>) = (tags(old), tags(new));
        let old_to_new: Vec<_> = old_tags.iter().map(|tag| new_tags.binary_search(tag).ok()).collect();
        let sources = new_tags.iter().map(|tag| Some((old_tags.binary_search(tag).ok()?, false))).collect();
        let mut pairs = Pairs { old: old_locales, new: new_locales, old_to_new, sources };
        if pairs.sources.contains(&None) {
            pairs.find_stand_ins(old, new);
        }
        pairs
    }

    /// Determines for each added locale the old one whose texts most clips show in it.
    fn find_stand_ins(&mut self, old: &Bank<'_>, new: &Bank<'_>) {
        let new_to_old: HashMap<usize, usize> =
            self.old_to_new.iter().enumerate().filter_map(|(old, new)| Some(((*new)?, old))).collect();
        let mut counts: HashMap<(usize, usize), usize> = HashMap::new();
        for clip in new.clips().filter(|clip| old.clip_by_key(clip.key()).is_some()) {
            let texts = ShownTexts::of(&clip, &self.new);
            for (locale, shown) in texts.shown.iter().enumerate().filter(|(locale, _)| self.sources[*locale].is_none())
            {
                let stand_in = match shown {
                    ShownText::Fallback(other) => new_to_old.get(other),
                    _ => None,
                };
                stand_in.into_iter().for_each(|stand_in| *counts.entry((locale, *stand_in)).or_default() += 1);
            }
        }
        let mut counts: Vec<_> = counts.into_iter().collect();
        // The highest count goes last; among equal ones, the first locale.
        counts.sort_unstable_by_key(|((locale, stand_in), count)| (*count, std::cmp::Reverse((*locale, *stand_in))));
        for ((locale, stand_in), _) in counts {
            self.sources[locale] = Some((stand_in, true));
        }
    }

    /// Returns for each new locale the number of its stand-in.
    fn stand_ins(&self) -> Vec<u32> {
        let stand_in = |source: &Option<(usize, bool)>| {
            let (old, _) = source.filter(|(_, stands_in)| *stands_in)?;
            self.old_to_new.get(old).copied().flatten()
        };
        self.sources.iter().map(|source| stand_in(source).map_or(NO_STAND_IN, |number| number as u32)).collect()
    }

    /// Whether a stack shows the same text for a clip of the old bank in this locale as the new bank.
    fn shows_the_same(&self, old: &ShownTexts<'_>, new: &ShownTexts<'_>, locale: usize) -> bool {
        let Some((source, stands_in)) = self.sources[locale] else { return new.shown[locale] == ShownText::Nothing };
        let shown = match (old.shown[source], stands_in) {
            (ShownText::Own, true) => self.old_to_new[source].map(ShownText::Fallback),
            (ShownText::Fallback(other), _) => self.old_to_new[other].map(ShownText::Fallback),
            (shown, _) => Some(shown),
        };
        // The texts of other locales are compared there.
        shown == Some(new.shown[locale])
            && (matches!(shown, Some(ShownText::Nothing | ShownText::Fallback(_)))
                || old.segments(source) == new.segments(locale))
    }
}
