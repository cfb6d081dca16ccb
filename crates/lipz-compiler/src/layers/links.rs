//! Dubs of whole banks and of stacks, and what a layer says about them.

use super::content::{Shown, Texts};
use crate::dubs::{Dub, Dubs, borrows};
use lipz_bank::{Bank, Clip, LayeredClip, Layers, Locale, Spoken, Voice};
use lipz_layout::{LAYER_DUB, LAYER_DUB_OF, LAYER_NO_DUB, LAYER_OTHER_DUB, LayerDubRecord};
use std::collections::HashMap;

/// What a layer says about dubs.
#[derive(Default)]
pub(super) struct Links {
    /// In the order of a section.
    pub(super) records: Vec<LayerDubRecord>,
    /// The voices: all of the bank, if one of those below is gone; none if nothing is new.
    pub(super) voices: Vec<String>,
    /// Whether no other voice counts.
    pub(super) are_all: bool,
}

impl Links {
    /// What makes the dubs of one bank of those of another.
    pub(super) fn between(old: &Bank<'_>, new: &Bank<'_>) -> Links {
        let tags = |bank: &Bank<'_>| bank.voices().map(|voice| voice.tag().to_owned()).collect::<Vec<String>>();
        let (old_tags, new_tags) = (tags(old), tags(new));
        let are_all = old_tags.first().is_some_and(|original| new_tags.first() != Some(original))
            || !old_tags.iter().all(|tag| new_tags.contains(tag));
        let mut records = Vec::new();
        for clip in new.clips() {
            let before = old.clip_by_key(clip.key());
            for (number, voice) in (0..).zip(new.voices()).skip(1) {
                let old_voice = old.voice(voice.tag()).filter(|_| !are_all);
                let was = before.as_ref().zip(old_voice).map_or((LAYER_NO_DUB, 0), |(clip, voice)| said(clip, voice));
                let says = said(&clip, voice);
                if says != was {
                    let (kind, other) = says;
                    records.push(LayerDubRecord {
                        clip_id: clip.id().get().into(),
                        other_id: other.into(),
                        voice: number.into(),
                        kind: kind.into(),
                        reserved: [0; 4],
                    });
                }
            }
        }
        records.sort_unstable_by_key(|record: &LayerDubRecord| (record.clip_id.get(), record.voice.get()));
        let is_said = are_all || !records.is_empty() || old_tags != new_tags;
        Links { records, voices: if is_said { new_tags } else { Vec::new() }, are_all }
    }
}

/// What a bank says about a clip in a voice: the kind of a record and the other clip.
fn said(clip: &Clip<'_, '_>, voice: Voice<'_>) -> (u16, u64) {
    if let Some(original) = clip.original() {
        let is_own = clip.voice().is_some_and(|own| own.tag() == voice.tag());
        return if is_own { (LAYER_DUB_OF, original.id().get()) } else { (LAYER_NO_DUB, 0) };
    }
    let voiced = clip.in_voice(voice);
    match voiced.spoken {
        Spoken::Dub => (LAYER_DUB, voiced.clip.id().get()),
        Spoken::OtherDub => (LAYER_OTHER_DUB, voiced.clip.id().get()),
        _ => (LAYER_NO_DUB, 0),
    }
}

/// Whose the texts of a clip are.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) enum Whose {
    /// All are those of the original, if only because neither has one.
    Original,
    /// For each locale whether the text is that of the original.
    Some(Vec<bool>),
}

impl Whose {
    /// Whose the texts of a clip of a whole bank are.
    pub(super) fn of(clip: &Clip<'_, '_>, locales: &[Locale<'_>]) -> Whose {
        let Some(original) = clip.original() else { return Whose::Some(vec![false; locales.len()]) };
        let is_same = |locale: &Locale<'_>| borrows(clip, Some(&original), *locale);
        if locales.iter().all(is_same) {
            return Whose::Original;
        }
        let has_text = |locale: &Locale<'_>| clip.segment(0).is_some_and(|segment| segment.text(*locale).is_some());
        Whose::Some(locales.iter().map(|locale| has_text(locale) && is_same(locale)).collect())
    }

    /// The same of a clip of a stack that shows these `texts`, a dub whose original shows `theirs`.
    pub(super) fn of_layered<const N: usize>(
        clip: &LayeredClip<'_, '_>,
        layers: &Layers<'_, N>,
        tags: &[&str],
        (texts, theirs): (&Texts<'_>, &Texts<'_>),
    ) -> Vec<bool> {
        let (Some(at), Some(of_texts)) = (clip.texts_layer(), clip.texts()) else { return vec![false; tags.len()] };
        let bank = layers.bank(at);
        let layer = bank.and_then(Bank::layer).filter(|_| at > 0);
        let original = of_texts.original();
        let is_said = |tag: &str| match &layer {
            _ if of_texts.id() != clip.id() => true,
            Some(layer) => {
                let place = bank.and_then(|bank| bank.locales().position(|locale| locale.tag() == tag));
                place.is_some_and(|place| layer.borrows(of_texts.slot(), place))
            }
            None => {
                let locale = bank.and_then(|bank| bank.locale(tag));
                locale.is_some_and(|locale| borrows(&of_texts, original.as_ref(), locale))
            }
        };
        // Layers that do not know each other may have changed one of the two.
        let is_same = |locale: usize| {
            let is_own = |texts: &Texts<'_>| texts.shown[locale] == Shown::Own;
            is_own(texts) && is_own(theirs) && texts.segments(locale) == theirs.segments(locale)
        };
        tags.iter().enumerate().map(|(locale, tag)| is_same(locale) && is_said(tag)).collect()
    }

    /// Whether the text in a locale is that of the original, as far as there is one.
    pub(super) fn is_original(&self, locale: usize) -> bool {
        match self {
            Whose::Original => true,
            Whose::Some(borrowed) => borrowed.get(locale).copied().unwrap_or_default(),
        }
    }
}

/// The dubs among these clips of a stack, which are in the order of their keys.
pub(super) fn dubs_of<'d, 'b, const N: usize>(layers: &'b Layers<'d, N>, clips: &[LayeredClip<'d, 'b>]) -> Dubs {
    let voices: Vec<String> = layers.voices().map(|voice| voice.tag().to_owned()).collect();
    if voices.is_empty() {
        return Dubs::default();
    }
    let places: HashMap<_, usize> = clips.iter().map(|clip| clip.id()).zip(0..).collect();
    let mut of = vec![None; places.len()];
    let mut others = Vec::new();
    for (at, clip) in clips.iter().enumerate() {
        if let (Some(original), Some(voice)) = (clip.original(layers), clip.voice(layers)) {
            let voice = voices.iter().position(|tag| tag == voice.tag());
            of[at] = voice.zip(places.get(&original.id())).map(|(voice, &original)| Dub { voice, original });
            continue;
        }
        for (voice, asked) in layers.voices().enumerate().skip(1) {
            let voiced = clip.in_voice(&asked);
            let other = places.get(&voiced.clip.id()).filter(|_| voiced.spoken == Spoken::OtherDub);
            others.extend(other.map(|&other| (Dub { voice, original: at }, other)));
        }
    }
    Dubs::new(voices, of, others)
}
