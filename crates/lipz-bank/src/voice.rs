//! The voices of a bank: languages with recordings of their own, whose mouths are dubs.

use crate::file::{File, entries};
use crate::origin::Origin;
use crate::{Bank, Clip};
use core::fmt;
use core::iter::FusedIterator;
use lipz_layout::{DUB_OF, NO_DUB, OTHER_DUB, Tag, U32};

/// A language in which lines are recorded: that of the original, or one with dubs.
///
/// Look it up once, with [`Bank::voice`], and ask each clip for its mouth in that voice with [`Clip::in_voice`].
///
/// A voice knows its bank. With a clip of another bank, or of another version of its bank, it leads to the clip itself
/// (and debug builds stop with an assertion): look it up again when a bank is replaced.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct Voice<'data> {
    bank: Origin,
    tag: &'data [u8],
    /// What stands for the clip in each slot; `None` for the voice of the originals.
    dubs: Option<&'data [U32]>,
}

impl<'data> Voice<'data> {
    /// The locale of the voice: `de-de`. Empty only in a damaged bank.
    pub fn tag(&self) -> &'data str {
        core::str::from_utf8(self.tag).unwrap_or("")
    }

    /// Whether this is the voice of the original recordings, in which no clip is a dub.
    pub const fn is_original(&self) -> bool {
        self.dubs.is_none()
    }

    /// Whether the voice is one of `bank`.
    pub fn is_of(&self, bank: &Bank<'_>) -> bool {
        self.bank == bank.origin()
    }

    /// The entry of the clip in this slot; that of no dub, if there is none.
    pub(crate) fn entry(&self, slot: u32) -> u32 {
        self.dubs.and_then(|dubs| dubs.get(slot as usize)).map_or(NO_DUB, |entry| entry.get())
    }

    /// The slot of the clip of which that in `slot` is a dub in this voice.
    fn original_of(&self, slot: u32) -> Option<u32> {
        let entry = self.entry(slot);
        if entry != NO_DUB && entry & DUB_OF != 0 { Some(entry & !DUB_OF) } else { None }
    }
}

/// The locale.
impl fmt::Debug for Voice<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Voice({:?})", self.tag())
    }
}

/// Whose mouth shapes and times a clip in a voice has.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[non_exhaustive]
pub enum Spoken {
    /// Those of the original: the line is not dubbed, or the original was asked for.
    Original,
    /// Those of the dub in the voice that was asked for.
    Dub,
    /// Those of the dub in another voice, which the one that was asked for falls back to.
    OtherDub,
}

/// A clip as it is played in a voice.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct VoicedClip<'data, 'bank> {
    /// The clip: its mouth, its times, its texts and its events are those of the recording in that voice.
    pub clip: Clip<'data, 'bank>,
    /// Whether it is the dub, or what stands for it.
    pub spoken: Spoken,
}

impl<'data> Bank<'data> {
    /// The voice in this locale, spelled as in the bank (`de-de`); `None` if the bank has no dubs, or the project names no
    /// such voice: play the clips as they are.
    pub fn voice(&self, tag: &str) -> Option<Voice<'data>> {
        self.voices().find(|voice| voice.tag == tag.as_bytes())
    }

    /// The voices of the bank: that of the originals first, then those of the dubs in the order of their tags. None in a
    /// bank without dubs.
    pub fn voices(&self) -> Voices<'data> {
        Voices {
            bank: self.origin(),
            clip_count: self.clips.len(),
            tags: tags(&self.file),
            dubs: dubs(&self.file),
            is_first: true,
        }
    }
}

impl<'data, 'bank> Clip<'data, 'bank> {
    /// The clip as it is played in `voice`: the dub in it; if there is none, that in a voice that this one falls back to,
    /// as the project says; otherwise the original.
    ///
    /// The clip may be the original or any of its dubs. A dub has a frame rate and a viseme type of its own: give what
    /// they default to ([`Clip::or_fps`]) to the clip that comes back.
    ///
    /// ```
    /// use lipz_bank::{Bank, Clip, Spoken};
    /// /// What a game plays for a line: the mouth, and whether the sound of the dub belongs to it.
    /// fn line<'a, 'b>(bank: &'b Bank<'a>, key: &str, spoken_in: &str) -> Option<(Clip<'a, 'b>, bool)> {
    ///     let clip = bank.clip_by_key(key)?;
    ///     match bank.voice(spoken_in) {
    ///         Some(voice) => {
    ///             let voiced = clip.in_voice(voice);
    ///             Some((voiced.clip, voiced.spoken == Spoken::Dub))
    ///         }
    ///         None => Some((clip, false)),
    ///     }
    /// }
    /// ```
    pub fn in_voice(&self, voice: Voice<'_>) -> VoicedClip<'data, 'bank> {
        voice.bank.assert_is(self.bank.origin());
        let original = if voice.is_of(self.bank) { self.original().unwrap_or(*self) } else { *self };
        let entry = if voice.is_of(self.bank) { voice.entry(original.slot()) } else { NO_DUB };
        let spoken = if entry & OTHER_DUB == 0 { Spoken::Dub } else { Spoken::OtherDub };
        // No slot is as great as the number of no dub.
        match self.bank.clip_at(entry & !OTHER_DUB) {
            Some(clip) => VoicedClip { clip, spoken },
            None => VoicedClip { clip: original, spoken: Spoken::Original },
        }
    }

    /// The voice whose recording the mouth of this clip belongs to; `None` in a bank without dubs.
    pub fn voice(&self) -> Option<Voice<'data>> {
        let of_dub = self.bank.voices().find(|voice| voice.original_of(self.slot()).is_some());
        of_dub.or_else(|| self.bank.voices().next())
    }

    /// The clip of which this one is a dub; `None` if it is none.
    pub fn original(&self) -> Option<Clip<'data, 'bank>> {
        let slot = self.bank.voices().find_map(|voice| voice.original_of(self.slot()))?;
        self.bank.clip_at(slot)
    }
}

/// The tags of the voices, each with a zero byte behind it.
pub(crate) fn tags<'data>(file: &File<'data>) -> &'data [u8] {
    file.section(Tag::VOICES)
}

/// The entries of all voices but the original.
pub(crate) fn dubs<'data>(file: &File<'data>) -> &'data [U32] {
    entries(file.section(Tag::DUBS))
}

/// The voices of a bank.
#[derive(Clone)]
pub struct Voices<'data> {
    bank: Origin,
    clip_count: usize,
    /// The tags that are left.
    tags: &'data [u8],
    /// The entries that are left.
    dubs: &'data [U32],
    is_first: bool,
}

impl<'data> Iterator for Voices<'data> {
    type Item = Voice<'data>;

    fn next(&mut self) -> Option<Voice<'data>> {
        let end = self.tags.iter().position(|byte| *byte == 0)?;
        let tag = self.tags.get(..end)?;
        let dubs = if self.is_first {
            None
        } else {
            let own = self.dubs.get(..self.clip_count)?;
            self.dubs = self.dubs.get(self.clip_count..)?;
            Some(own)
        };
        self.is_first = false;
        self.tags = self.tags.get(end.wrapping_add(1)..)?;
        Some(Voice { bank: self.bank, tag, dubs })
    }
}

impl FusedIterator for Voices<'_> {}

/// The voices that are left.
impl fmt::Debug for Voices<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.clone()).finish()
    }
}
