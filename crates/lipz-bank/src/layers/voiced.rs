//! Clips of a stack in a voice.

use super::{LayeredClip, Layers, Stacked, original_of, played_in, voice_tags};
use crate::{Bank, ClipId, Spoken};
use core::fmt;

/// A voice of [`Layers`]. Look it up once, with [`Layers::voice`], and ask each clip for its mouth in that voice with
/// [`LayeredClip::in_voice`].
#[derive(Clone, Copy)]
pub struct LayeredVoice<'data, 'bank, const N: usize> {
    layers: &'bank Layers<'data, N>,
    tag: &'data str,
}

/// A clip of a stack as it is played in a voice.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct LayeredVoicedClip<'data, 'bank> {
    /// The clip: its mouth, its times, its texts and its events are those of the recording in that voice.
    pub clip: LayeredClip<'data, 'bank>,
    /// Whether it is the dub, or what stands for it.
    pub spoken: Spoken,
}

impl<'data, const N: usize> LayeredVoice<'data, '_, N> {
    /// The locale of the voice: `de-de`.
    pub fn tag(&self) -> &'data str {
        self.tag
    }

    /// Whether this is the voice of the original recordings, in which no clip is a dub.
    pub fn is_original(&self) -> bool {
        voice_tags(self.layers).next() == Some(self.tag)
    }
}

impl<'data, const N: usize> Layers<'data, N> {
    /// The voice in this locale, spelled as in the banks (`de-de`); `None` if the stack has no dubs, or the project names
    /// no such voice: play the clips as they are.
    pub fn voice(&self, tag: &str) -> Option<LayeredVoice<'data, '_, N>> {
        self.voices().find(|voice| voice.tag == tag)
    }

    /// The voices of the stack: that of the originals first, then those of the dubs in the order of their tags.
    pub fn voices(&self) -> impl Iterator<Item = LayeredVoice<'data, '_, N>> {
        voice_tags(self).map(move |tag| LayeredVoice { layers: self, tag })
    }
}

/// These ask the stack: the banks that the clips are from know only their own dubs.
impl<'data, 'bank> LayeredClip<'data, 'bank> {
    /// The clip as it is played in `voice`, as [`Clip::in_voice`](crate::Clip::in_voice) has it.
    pub fn in_voice<const N: usize>(&self, voice: &LayeredVoice<'data, 'bank, N>) -> LayeredVoicedClip<'data, 'bank> {
        let original = self.original(voice.layers).unwrap_or(*self);
        let played = played_in(voice.layers, original.id(), voice.tag);
        let played = played.and_then(|(id, spoken)| Some((voice.layers.clip(id)?, spoken)));
        let (clip, spoken) = played.unwrap_or((original, Spoken::Original));
        LayeredVoicedClip { clip, spoken }
    }

    /// The voice whose recording the mouth of this clip belongs to; `None` in a stack without dubs.
    pub fn voice<const N: usize>(&self, layers: &'bank Layers<'data, N>) -> Option<LayeredVoice<'data, 'bank, N>> {
        let of_dub = original_of(layers, self.id()).map(|(tag, _)| tag);
        let tag = of_dub.or_else(|| voice_tags(layers).next())?;
        Some(LayeredVoice { layers, tag })
    }

    /// The clip of which this one is a dub; `None` if it is none.
    pub fn original<const N: usize>(&self, layers: &'bank Layers<'data, N>) -> Option<LayeredClip<'data, 'bank>> {
        layers.clip(original_of(layers, self.id())?.1)
    }
}

impl<'data, const N: usize> Stacked<'data> for Layers<'data, N> {
    fn bank_at(&self, at: usize) -> Option<Bank<'data>> {
        self.bank(at).copied()
    }

    /// That of the topmost layer which has more than texts.
    fn segment_count(&self, id: ClipId) -> Option<u32> {
        for layer in self.all().iter().rev() {
            match layer.bank.find(id) {
                Some((slot, _)) if layer.table.parts(slot).0 => return Some(layer.bank.clip_at(slot)?.segment_count()),
                None if layer.table.removes(id) => return None,
                _ => {}
            }
        }
        None
    }
}

/// The locale.
impl<const N: usize> fmt::Debug for LayeredVoice<'_, '_, N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "LayeredVoice({:?})", self.tag)
    }
}
