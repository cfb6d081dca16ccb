//! Dubs of a bank below the packed one, whose clips stay.

use super::{Dub, Dubs};
use crate::clip::Clip;
use lipz_bank::{Bank, VoiceSource};
use std::collections::BTreeMap;

/// The dubs of a bank, by keys.
#[derive(Debug, Default)]
pub(crate) struct KeptDubs {
    /// The locales of the voices, with that of the originals first.
    pub(crate) voices: Vec<String>,
    /// For each dub, its voice and its original.
    pub(crate) originals: BTreeMap<String, (String, String)>,
    /// For each original and voice without a dub, the dub that is played instead.
    others: BTreeMap<(String, String), String>,
}

impl KeptDubs {
    /// Returns the dubs of a bank.
    pub(crate) fn of(bank: &Bank<'_>) -> KeptDubs {
        let mut kept = KeptDubs {
            voices: bank.voices().map(|voice| bank.voice_tag(voice).to_owned()).collect(),
            ..Self::default()
        };
        for clip in bank.clips() {
            let key = clip.key().to_owned();
            if let (Some(original), Some(voice)) = (clip.original(), clip.voice()) {
                kept.originals.insert(key, (bank.voice_tag(voice).to_owned(), original.key().to_owned()));
                continue;
            }
            for voice in bank.voices() {
                let voiced = clip.in_voice(voice);
                if voiced.spoken == VoiceSource::OtherDub {
                    kept.others.insert((key.clone(), bank.voice_tag(voice).to_owned()), voiced.clip.key().to_owned());
                }
            }
        }
        kept
    }

    /// Returns the original and the dubs of a clip's line, if it has dubs.
    pub(super) fn of_line(&self, key: &str) -> impl Iterator<Item = &str> {
        let original = self.originals.get(key).map_or(key, |(_, original)| original).to_owned();
        let of_line = self.originals.iter().filter(move |(_, (_, of))| *of == original);
        of_line.flat_map(|(dub, (_, original))| [dub.as_str(), original.as_str()])
    }

    /// Returns the voices of these clips together with others.
    pub(super) fn with_voices(&self, others: Vec<String>) -> Vec<String> {
        let Some(original) = self.voices.first().or(others.first()).cloned() else { return others };
        let mut dubbed: Vec<String> =
            self.voices.iter().cloned().chain(others).filter(|tag| *tag != original).collect();
        dubbed.sort_unstable();
        dubbed.dedup();
        [original].into_iter().chain(dubbed).collect()
    }

    /// Returns the clip whose dub this one is, from clips sorted by key.
    pub(super) fn dub(&self, clip: &Clip<'_>, clips: &[Clip<'_>], voices: &[String]) -> Option<Dub> {
        let (voice, original) = self.originals.get(clip.key())?;
        let original = clips.binary_search_by(|other| other.key().cmp(original)).ok()?;
        let voice = voices.iter().position(|tag| tag == voice)?;
        (clips[original].starts().len() == clip.starts().len()).then_some(Dub { voice, original })
    }

    /// Restores the fallback of lines with unchanged dubs, because an addition is packed with only its own voices.
    pub(super) fn restore(&self, dubs: &mut Dubs, clips: &[Clip<'_>]) {
        if self.voices.is_empty() || dubs.voices.is_empty() {
            return;
        }
        let place = |key: &str| clips.binary_search_by(|clip| clip.key().cmp(key)).ok();
        let mut before: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
        for (dub, (_, original)) in &self.originals {
            before.entry(original).or_default().push(dub);
        }
        let mut after: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
        for (at, dub) in dubs.iter() {
            after.entry(clips[dub.original].key()).or_default().push(clips[at].key());
        }
        let is_same = |original: &str| before.get(original) == after.get(original);
        let is_known = |voice: usize| self.voices.contains(&dubs.voices[voice]);
        let mut others = std::mem::take(&mut dubs.others);
        others.retain(|(dub, _)| !is_known(dub.voice) || !is_same(clips[dub.original].key()));
        for ((original, voice), other) in self.others.iter().filter(|((original, _), _)| is_same(original)) {
            let voice = dubs.voices.iter().position(|tag| tag == voice);
            if let (Some(voice), Some(original), Some(other)) = (voice, place(original), place(other)) {
                others.push((Dub { voice, original }, other));
            }
        }
        dubs.others = others;
    }
}
