//! The voices of a dialogue, and its dubs with their originals.

use super::stack::Level;
use super::{Answers, Base, Dialogue, Layer};
use crate::{Bank, Clip, ClipId, Voice, VoiceSource, VoicedClip};
use lipz_layout::{DUB_OF, LAYER_DUB, LAYER_DUB_OF, LAYER_NO_DUB, LAYER_OTHER_DUB, LayerDubRecord, NO_DUB, OTHER_DUB};

/// A file's entry for a clip in a voice.
enum VoiceEntry {
    /// The clip is not dubbed here.
    Nothing,
    Dub(ClipId),
    /// The dub in a different voice.
    OtherDub(ClipId),
    DubOf(ClipId),
}

/// Whether the layer's entry is valid, for any clips.
pub(super) fn is_entry(dub: &LayerDubRecord) -> bool {
    match dub.kind.get() {
        LAYER_NO_DUB => dub.other_id.get() == 0,
        LAYER_DUB | LAYER_DUB_OF | LAYER_OTHER_DUB => dub.other_id != dub.clip_id,
        _ => false,
    }
}

/// The patch lists its voices without this one, so the files below it do not count.
struct NoVoice;

impl<'a> Dialogue<'a> {
    /// Returns the voice in this locale, spelled as in the files (`de-de`). `None` if there are no dubs, or if the
    /// project does not define this voice: play the clips unchanged.
    pub fn voice(&self, tag: &str) -> Option<Voice> {
        self.voices().find(|voice| self.voice_tag(*voice) == tag)
    }

    /// Returns the voices: that of the originals first, then those of the dubs, ordered by tag.
    ///
    /// Files list voices. Those below the topmost complete list do not count.
    pub fn voices(&self) -> impl Iterator<Item = Voice> + '_ {
        let (alone, queries) = match self.answers {
            Answers::Alone(bank) => (Some(bank), None),
            Answers::Together(queries) => (None, Some(queries)),
        };
        let next = move |before| (queries?.next_voice)(self, before);
        let together = core::iter::successors(next(None), move |before| next(Some(*before)));
        alone.into_iter().flat_map(Bank::voices).chain(together)
    }

    /// Returns the voice after the given one, or the first.
    pub(super) fn next_voice_in_files(&self, before: Option<Voice>) -> Option<Voice> {
        match before {
            None => self.original_voice(),
            Some(voice) if Some(voice) == self.original_voice() => self.voice_behind(""),
            Some(voice) => self.voice_behind(self.voice_tag(voice)),
        }
    }

    /// Returns the voice of dubs with the first tag after this one.
    fn voice_behind(&self, before: &str) -> Option<Voice> {
        let of_original = self.voice_tag(self.original_voice()?);
        let listed = self.levels_with_voices().flat_map(|level| self.listed(level).skip(1));
        let behind = listed.filter(|(tag, _)| *tag > before && *tag != of_original);
        Some(behind.min_by(|(tag, _), (other, _)| tag.cmp(other))?.1)
    }

    /// Returns the locale of a voice: `de-de`. Empty for a voice of another dialogue, and in a damaged file.
    pub fn voice_tag(&self, voice: Voice) -> &'a str {
        match self.answers {
            Answers::Alone(bank) => bank.voice_tag(voice),
            Answers::Together(queries) => (queries.voice_tag)(self, voice),
        }
    }

    pub(super) fn voice_tag_in_files(&self, voice: Voice) -> &'a str {
        let find = || {
            let file = self.bank_file(usize::from(voice.file)).filter(|_| voice.origin == self.origin)?;
            let layer = if self.is_base(usize::from(voice.file)) { None } else { file.layer.as_ref() };
            let level = Level { number: usize::from(voice.file), file, layer };
            self.listed(level).nth(usize::from(voice.index))
        };
        find().map_or("", |(tag, _)| tag)
    }

    /// Whether the file with this number is the base, or a bank of the base's set.
    fn is_base(&self, number: usize) -> bool {
        number < self.behind_base()
    }

    /// Returns the voice of the originals, from the topmost file that lists voices.
    fn original_voice(&self) -> Option<Voice> {
        let mut original = None;
        for level in self.levels_with_voices() {
            original = self.listed(level).next().or(original);
        }
        original.map(|(_, voice)| voice)
    }

    /// Returns the levels from the topmost complete list of voices upwards, or from the base, the lowest first.
    fn levels_with_voices(&self) -> impl Iterator<Item = Level<'a>> + '_ {
        let patches = (0..self.patch_count).filter_map(move |patch| self.patch(patch));
        let complete = |level: &Level<'a>| level.layer.map_or(false, Layer::has_voices);
        let last = patches.clone().rev().find(complete).map(|level| level.number);
        let bases = if last.is_some() { 0..0 } else { self.bases() };
        let bases = bases.filter_map(move |number| Some(Level { number, file: self.bank_file(number)?, layer: None }));
        bases.chain(patches.skip_while(move |level| last.map_or(false, |last| level.number != last)))
    }

    /// Returns the numbers of the banks that form the base.
    fn bases(&self) -> core::ops::Range<usize> {
        match &self.base {
            Base::Bank(_) => 0..1,
            Base::Set(_) => 1..self.behind_base(),
        }
    }

    /// Returns the voices that a file lists, with their tags.
    fn listed(&self, level: Level<'a>) -> impl Iterator<Item = (&'a str, Voice)> + '_ {
        let bank: &'a Bank<'a> = &level.file.bank;
        let of_base =
            if level.layer.is_none() { Some(bank.voices().map(move |voice| bank.voice_tag(voice))) } else { None };
        let of_patch = level.layer.map(Layer::voices);
        let tags = of_base.into_iter().flatten().chain(of_patch.into_iter().flatten());
        let (origin, file) = (self.origin, level.number as u16);
        tags.zip(0..=u16::MAX).map(move |(tag, index)| (tag, Voice { origin, file, index }))
    }

    /// Returns the clip as played in a voice.
    pub(super) fn clip_in_voice<'d>(&'d self, clip: &Clip<'d>, voice: Voice) -> VoicedClip<'d> {
        let tag = self.voice_tag(voice);
        if tag.is_empty() {
            return VoicedClip::new(*clip, VoiceSource::Original);
        }
        let original = match self.original_id(clip.id()).and_then(|(_, original)| self.clip(original)) {
            Some(original) => original,
            None => *clip,
        };
        let played = self.played_in(original.id(), tag).and_then(|(id, spoken)| Some((self.clip(id)?, spoken)));
        let (clip, spoken) = played.unwrap_or((original, VoiceSource::Original));
        VoicedClip::new(clip, spoken)
    }

    /// Returns the original of the dub with this id, and the voice; `None` if the clip is not a dub. An original is
    /// never itself a dub, and has as many segments as the dub, but patches that were packed independently of each
    /// other can contradict this.
    pub(super) fn original_id(&self, id: ClipId) -> Option<(Voice, ClipId)> {
        let (voice, original) = self.said_original(id)?;
        let segment_count = self.segment_count(original)?;
        let fits = self.segment_count(id) == Some(segment_count) && self.said_original(original).is_none();
        if fits { Some((voice, original)) } else { None }
    }

    /// Returns the original of the clip with this id as stored in the files.
    fn said_original(&self, id: ClipId) -> Option<(Voice, ClipId)> {
        for voice in self.voices().skip(1) {
            let tag = self.voice_tag(voice);
            for level in self.all_levels_of(id) {
                match entry(level, id, tag) {
                    Ok(Some(VoiceEntry::DubOf(original))) => return Some((voice, original)),
                    Ok(None) => {}
                    Ok(Some(_)) | Err(NoVoice) => break,
                }
            }
        }
        None
    }

    /// Returns the clip that is played in a voice for the original with this id; `None` if the original is played. A
    /// dub in this voice counts in any file. Among dubs in other voices, that of the topmost file counts.
    fn played_in(&self, original: ClipId, voice: &str) -> Option<(ClipId, VoiceSource)> {
        let mut other: Option<ClipId> = None;
        for level in self.all_levels_of(original) {
            match entry(level, original, voice) {
                Ok(Some(VoiceEntry::Dub(dub))) => {
                    if self.original_id(dub).map_or(false, |(of, id)| self.voice_tag(of) == voice && id == original) {
                        return Some((dub, VoiceSource::Dub));
                    }
                }
                Ok(Some(VoiceEntry::OtherDub(dub))) => {
                    if self.original_id(dub).map_or(false, |(_, of)| of == original) {
                        other = other.or(Some(dub));
                    }
                }
                Ok(None) => {}
                Ok(Some(VoiceEntry::Nothing | VoiceEntry::DubOf(_))) | Err(NoVoice) => break,
            }
        }
        other.map(|dub| (dub, VoiceSource::OtherDub))
    }

    /// Returns the patches from the top, then the base.
    fn all_levels_of(&self, id: ClipId) -> impl Iterator<Item = Level<'a>> + '_ {
        (0..self.patch_count).rev().filter_map(move |patch| self.patch(patch)).chain(self.base_of(id))
    }
}

/// Returns a file's entry for a clip in a voice, if there is one.
fn entry(level: Level<'_>, id: ClipId, voice: &str) -> Result<Option<VoiceEntry>, NoVoice> {
    let layer = match level.layer {
        Some(layer) => layer,
        None => return Ok(in_base(&level.file.bank, id, voice)),
    };
    let number = match (layer.voices().skip(1).position(|tag| tag == voice), layer.has_voices()) {
        (Some(place), _) => place.saturating_add(1),
        (None, true) => return Err(NoVoice),
        (None, false) => return Ok(None),
    };
    let place = (id.get(), number);
    let found = layer.dubs.binary_search_by(|dub| (dub.clip_id.get(), usize::from(dub.voice.get())).cmp(&place));
    let dub = found.ok().and_then(|found| layer.dubs.get(found));
    Ok(dub.map(|dub| {
        let other = ClipId::from_u64(dub.other_id.get());
        match dub.kind.get() {
            LAYER_DUB => VoiceEntry::Dub(other),
            LAYER_OTHER_DUB => VoiceEntry::OtherDub(other),
            LAYER_DUB_OF => VoiceEntry::DubOf(other),
            _ => VoiceEntry::Nothing,
        }
    }))
}

/// Returns the same in the base, which stores it by slots.
fn in_base(base: &Bank<'_>, id: ClipId, voice: &str) -> Option<VoiceEntry> {
    let dubs = base.dubs().skip(1).find(|dubs| dubs.tag == voice.as_bytes())?;
    let entry = dubs.entry(base.find(id)?.0);
    if entry == NO_DUB {
        return None;
    }
    let other = base.clip_at(entry & !(DUB_OF | OTHER_DUB))?.id();
    Some(match (entry & DUB_OF != 0, entry & OTHER_DUB != 0) {
        (true, _) => VoiceEntry::DubOf(other),
        (false, true) => VoiceEntry::OtherDub(other),
        (false, false) => VoiceEntry::Dub(other),
    })
}
