//! The voices of a bank: languages with their own recordings, whose visemes are in dubs.

mod check;

pub(crate) use check::check;

use crate::file::{File, entries};
use crate::origin::Origin;
use crate::{Bank, Clip};
use core::iter::FusedIterator;
use lipz_layout::{DUB_OF, NO_DUB, OTHER_DUB, Tag, U32};

/// A language in which lines are recorded: that of the originals, or one with dubs.
///
/// Look it up once, with `voice("de-de")`, and get each clip in that voice with [`Clip::in_voice`]. It is two numbers
/// that borrow nothing. Its tag is `voice_tag(voice)`.
///
/// A voice belongs to the dialogue in which it was looked up. With a clip of another dialogue, or of another version of
/// it, it leads to the clip itself: look the voice up again after a refresh.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Voice {
    pub(crate) origin: Origin,
    /// The file that lists the voice.
    pub(crate) file: u16,
    /// Its index in the list; 0 for the voice of the originals.
    pub(crate) index: u16,
}

impl Voice {
    /// Whether this is the voice of the original recordings, in which no clip is a dub.
    pub const fn is_original(self) -> bool {
        self.index == 0
    }

    /// Returns the handle as numbers, for a struct of another language.
    pub const fn to_words(self) -> [u32; 2] {
        [self.origin.to_u32(), (self.file as u32) << 16 | self.index as u32]
    }

    /// Returns the handle of [`Voice::to_words`]. Any numbers are accepted; invalid ones lead to the clip itself.
    pub const fn from_words([origin, place]: [u32; 2]) -> Voice {
        Voice { origin: Origin::from_u32(origin), file: (place >> 16) as u16, index: place as u16 }
    }
}

/// The dubs of one voice of a bank.
#[derive(Clone, Copy)]
pub(crate) struct Dubs<'data> {
    pub(crate) tag: &'data [u8],
    /// The replacement of the clip in each slot; `None` for the voice of the originals.
    entries: Option<&'data [U32]>,
}

impl Dubs<'_> {
    /// Returns the entry of the clip in this slot; [`NO_DUB`] if it has none.
    pub(crate) fn entry(&self, slot: u32) -> u32 {
        self.entries.and_then(|entries| entries.get(slot as usize)).map_or(NO_DUB, |entry| entry.get())
    }

    /// Returns the slot of the original, if the clip in `slot` is a dub in this voice.
    fn original_of(&self, slot: u32) -> Option<u32> {
        let entry = self.entry(slot);
        if entry != NO_DUB && entry & DUB_OF != 0 { Some(entry & !DUB_OF) } else { None }
    }
}

/// The source of a clip's visemes and times in a voice.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[non_exhaustive]
pub enum VoiceSource {
    /// The original: the line is not dubbed, or the original was requested.
    Original,
    /// The dub in the requested voice.
    Dub,
    /// The dub in another voice, which the requested one falls back to.
    OtherDub,
}

/// A clip as played in a voice.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct VoicedClip<'a> {
    /// The clip. Its visemes, times, texts and events belong to the recording in that voice.
    pub clip: Clip<'a>,
    /// Whether it is the dub, or a replacement for it.
    pub spoken: VoiceSource,
}

impl<'a> VoicedClip<'a> {
    pub(crate) fn new(clip: Clip<'a>, spoken: VoiceSource) -> VoicedClip<'a> {
        VoicedClip { clip, spoken }
    }
}

impl<'data> Bank<'data> {
    /// Returns the voice in this locale, spelled as in the bank (`de-de`). `None` if the bank has no dubs, or if the
    /// project does not define this voice: play the clips unchanged.
    pub fn voice(&self, tag: &str) -> Option<Voice> {
        self.voices().find(|voice| self.voice_tag(*voice) == tag)
    }

    /// Returns the voices of the bank: that of the originals first, then those of the dubs, ordered by tag. Empty in a
    /// bank without dubs.
    pub fn voices(&self) -> impl Iterator<Item = Voice> + Clone + '_ {
        let numbers = self.dubs().take(1 << 16).zip(0..);
        numbers.map(move |(_, index)| Voice { origin: self.origin, file: 0, index: index as u16 })
    }

    /// Returns the locale of a voice: `de-de`. Empty for a voice of another bank, and in a damaged bank.
    pub fn voice_tag(&self, voice: Voice) -> &'data str {
        let tag = self.dubs_of(voice).and_then(|dubs| core::str::from_utf8(dubs.tag).ok());
        tag.unwrap_or("")
    }

    /// Returns the dubs of each voice.
    pub(crate) fn dubs(&self) -> AllDubs<'data> {
        AllDubs { clip_count: self.clips.len(), tags: tags(&self.file), dubs: dubs(&self.file), is_first: true }
    }

    /// Returns the dubs of a voice of this bank.
    fn dubs_of(&self, voice: Voice) -> Option<Dubs<'data>> {
        if voice.origin == self.origin { self.dubs().nth(usize::from(voice.index)) } else { None }
    }

    /// Returns the voice number of the dub in this slot, and the slot of its original.
    fn original_in(&self, slot: u32) -> Option<(u32, u32)> {
        (0..).zip(self.dubs()).find_map(|(index, dubs)| Some((index, dubs.original_of(slot)?)))
    }
}

impl<'a> Clip<'a> {
    /// Returns the clip as played in `voice`: its dub, or the dub in the voice that the project falls back to, or the
    /// original.
    ///
    /// The clip may be the original or any of its dubs. A dub has its own frame rate and viseme type: call
    /// [`Clip::or_fps`] on the returned clip.
    ///
    /// ```
    /// use lipz_bank::{Bank, Clip, VoiceSource};
    /// /// Returns the clip that a game plays for a line, and whether to play the recording of the dub with it.
    /// fn line<'a>(bank: &'a Bank<'_>, key: &str, spoken_in: &str) -> Option<(Clip<'a>, bool)> {
    ///     let clip = bank.clip_by_key(key)?;
    ///     match bank.voice(spoken_in) {
    ///         Some(voice) => {
    ///             let voiced = clip.in_voice(voice);
    ///             Some((voiced.clip, voiced.spoken == VoiceSource::Dub))
    ///         }
    ///         None => Some((clip, false)),
    ///     }
    /// }
    /// ```
    pub fn in_voice(&self, voice: Voice) -> VoicedClip<'a> {
        if let Some((home, queries)) = self.together() {
            return (queries.in_voice)(home, self, voice);
        }
        let dubs = match self.bank.dubs_of(voice) {
            Some(dubs) => dubs,
            None => return VoicedClip::new(*self, VoiceSource::Original),
        };
        let original = self.original().unwrap_or(*self);
        let entry = dubs.entry(original.slot());
        let spoken = if entry & OTHER_DUB == 0 { VoiceSource::Dub } else { VoiceSource::OtherDub };
        // No slot is as great as [`NO_DUB`].
        match self.bank.clip_at(entry & !OTHER_DUB) {
            Some(clip) => VoicedClip::new(clip, spoken),
            None => VoicedClip::new(original, VoiceSource::Original),
        }
    }

    /// Returns the voice of the recording that this clip was made for; `None` in a bank without dubs.
    pub fn voice(&self) -> Option<Voice> {
        if let Some((home, queries)) = self.together() {
            return (queries.voice)(home, self);
        }
        let index = match self.bank.original_in(self.slot()) {
            Some((index, _)) => index,
            None => self.bank.dubs().next().map(|_| 0)?,
        };
        Some(Voice { origin: self.bank.origin, file: 0, index: index as u16 })
    }

    /// Returns the original of this dub; `None` if the clip is not a dub.
    pub fn original(&self) -> Option<Clip<'a>> {
        if let Some((home, queries)) = self.together() {
            return (queries.original)(home, self);
        }
        self.bank.clip_at(self.bank.original_in(self.slot())?.1)
    }
}

/// Returns the tags of the voices, each followed by a zero byte.
pub(crate) fn tags<'data>(file: &File<'data>) -> &'data [u8] {
    file.section(Tag::VOICES)
}

/// Returns the entries of all voices except the original.
pub(crate) fn dubs<'data>(file: &File<'data>) -> &'data [U32] {
    entries(file.section(Tag::DUBS))
}

/// The dubs of the voices of a bank.
#[derive(Clone)]
pub(crate) struct AllDubs<'data> {
    clip_count: usize,
    /// The remaining tags.
    tags: &'data [u8],
    /// The remaining entries.
    dubs: &'data [U32],
    is_first: bool,
}

impl<'data> Iterator for AllDubs<'data> {
    type Item = Dubs<'data>;

    fn next(&mut self) -> Option<Dubs<'data>> {
        let end = self.tags.iter().position(|byte| *byte == 0)?;
        let tag = self.tags.get(..end)?;
        let entries = if self.is_first {
            None
        } else {
            let own = self.dubs.get(..self.clip_count)?;
            self.dubs = self.dubs.get(self.clip_count..)?;
            Some(own)
        };
        self.is_first = false;
        self.tags = self.tags.get(end.wrapping_add(1)..)?;
        Some(Dubs { tag, entries })
    }
}

impl FusedIterator for AllDubs<'_> {}
