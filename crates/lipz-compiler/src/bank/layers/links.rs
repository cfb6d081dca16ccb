//! Dubs of banks and of dialogues, and their changes in a layer.

use crate::bank::dialogue::{DubTexts, TaggedLocale};
use crate::locales::dubs::{Dub, Dubs, borrows};
use lipz_bank::{Bank, Clip, Dialogue, Locale, VoiceSource};
use lipz_layout::{LAYER_DUB, LAYER_DUB_OF, LAYER_NO_DUB, LAYER_OTHER_DUB, LayerDubRecord};
use std::collections::HashMap;

/// The changes of dubs in a layer.
#[derive(Default)]
pub(super) struct Links {
    /// Sorted as in the section.
    pub(super) records: Vec<LayerDubRecord>,
    /// The voices: all voices of the bank if one of those below is removed; none if none is new.
    pub(super) voices: Vec<String>,
    /// Whether these are all voices.
    pub(super) are_all: bool,
}

impl Links {
    /// Returns the changes from the dubs of one bank to those of another.
    pub(super) fn between(old: &Bank<'_>, new: &Bank<'_>) -> Links {
        let tags =
            |bank: &Bank<'_>| bank.voices().map(|voice| bank.voice_tag(voice).to_owned()).collect::<Vec<String>>();
        let (old_tags, new_tags) = (tags(old), tags(new));
        let are_all = old_tags.first().is_some_and(|original| new_tags.first() != Some(original))
            || !old_tags.iter().all(|tag| new_tags.contains(tag));
        let mut records = Vec::new();
        for clip in new.clips() {
            let before = old.clip_by_key(clip.key());
            for (number, tag) in (0..).zip(&new_tags).skip(1) {
                let before = before.as_ref().filter(|_| !are_all);
                let was = before.map_or((LAYER_NO_DUB, 0), |clip| said(old, clip, tag));
                let says = said(new, &clip, tag);
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

/// Returns the statement of a bank about a clip in a voice: the kind of a record and the other clip.
fn said(bank: &Bank<'_>, clip: &Clip<'_>, tag: &str) -> (u16, u64) {
    let Some(voice) = bank.voice(tag) else { return (LAYER_NO_DUB, 0) };
    if let Some(original) = clip.original() {
        let is_own = clip.voice() == Some(voice);
        return if is_own { (LAYER_DUB_OF, original.id().get()) } else { (LAYER_NO_DUB, 0) };
    }
    let voiced = clip.in_voice(voice);
    match voiced.spoken {
        VoiceSource::Dub => (LAYER_DUB, voiced.clip.id().get()),
        VoiceSource::OtherDub => (LAYER_OTHER_DUB, voiced.clip.id().get()),
        _ => (LAYER_NO_DUB, 0),
    }
}

/// The owner of the texts of a clip.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) enum TextOwner {
    /// All texts belong to the original, or neither clip has a text.
    Original,
    /// Whether the text belongs to the original, for each locale.
    Some(Vec<bool>),
}

impl TextOwner {
    /// Returns the owner of the texts of a clip in a whole bank.
    pub(super) fn of(clip: &Clip<'_>, locales: &[Locale]) -> TextOwner {
        let Some(original) = clip.original() else { return TextOwner::Some(vec![false; locales.len()]) };
        let is_same = |locale: &Locale| borrows(clip, Some(&original), *locale);
        if locales.iter().all(is_same) {
            return TextOwner::Original;
        }
        let has_text = |locale: &Locale| clip.segment(0).is_some_and(|segment| segment.text(*locale).is_some());
        TextOwner::Some(locales.iter().map(|locale| has_text(locale) && is_same(locale)).collect())
    }

    /// Returns the owner of the texts of a clip in a dialogue.
    pub(super) fn of_dialogue<'d>(clip: &Clip<'d>, dialogue: &Dialogue<'d>, locales: &[TaggedLocale<'_>]) -> TextOwner {
        let of_dub = DubTexts::of(dialogue, clip);
        let are_borrowed = |dub: DubTexts<'d>| locales.iter().map(|locale| dub.are_borrowed(clip, locale)).collect();
        TextOwner::Some(of_dub.map(are_borrowed).unwrap_or_default())
    }

    /// Whether the text in a locale, if there is one, belongs to the original.
    pub(super) fn is_original(&self, locale: usize) -> bool {
        match self {
            TextOwner::Original => true,
            TextOwner::Some(borrowed) => borrowed.get(locale).copied().unwrap_or_default(),
        }
    }
}

/// Returns the dubs among these clips of a dialogue, which are sorted by key.
pub(super) fn dubs_of(dialogue: &Dialogue<'_>, clips: &[Clip<'_>]) -> Dubs {
    let voices: Vec<String> = dialogue.voices().map(|voice| dialogue.voice_tag(voice).to_owned()).collect();
    if voices.is_empty() {
        return Dubs::default();
    }
    let places: HashMap<_, usize> = clips.iter().map(Clip::id).zip(0..).collect();
    let mut of = vec![None; places.len()];
    let mut others = Vec::new();
    for (at, clip) in clips.iter().enumerate() {
        if let (Some(original), Some(voice)) = (clip.original(), clip.voice()) {
            let voice = voices.iter().position(|tag| tag == dialogue.voice_tag(voice));
            of[at] = voice.zip(places.get(&original.id())).map(|(voice, &original)| Dub { voice, original });
            continue;
        }
        for (voice, asked) in dialogue.voices().enumerate().skip(1) {
            let voiced = clip.in_voice(asked);
            let other = places.get(&voiced.clip.id()).filter(|_| voiced.spoken == VoiceSource::OtherDub);
            others.extend(other.map(|&other| (Dub { voice, original: at }, other)));
        }
    }
    Dubs::new(voices, of, others)
}
