//! A clip of a stack: what the topmost layer that has it says.

use super::{LayeredLocale, Places};
use crate::{Bank, Clip, Locale, Segment, Text};
use core::ops::Deref;

/// A clip of [`Layers`](crate::Layers): the [`Clip`] of the topmost layer that has it, and its texts.
///
/// It is used as a `Clip`, with a [`Cursor`](crate::Cursor), too. Only texts are asked for here, because another layer
/// may have them: where only a mouth was mended, its texts are those of the bank below it.
#[derive(Clone, Copy, Debug)]
pub struct LayeredClip<'data, 'bank> {
    clip: Clip<'data, 'bank>,
    /// Where it is, and where the clip with the texts is, which is made when it is asked for: mostly it is this one.
    places: Places,
    texts: Option<&'bank Bank<'data>>,
}

impl<'data, 'bank> LayeredClip<'data, 'bank> {
    /// A clip of these places; `texts` is the bank of its texts.
    #[inline]
    pub(super) fn new(
        clip: Clip<'data, 'bank>,
        places: Places,
        texts: Option<&'bank Bank<'data>>,
    ) -> LayeredClip<'data, 'bank> {
        LayeredClip { clip, places, texts }
    }

    /// The clip in its own bank.
    #[inline]
    pub const fn clip(&self) -> &Clip<'data, 'bank> {
        &self.clip
    }

    /// Index of the layer whose mouth shapes, segments, events and curves these are; 0 for the base.
    pub const fn layer(&self) -> usize {
        self.places.clip.layer() as usize
    }

    /// Index of the layer whose texts these are; `None` if no layer has any for this clip.
    pub fn texts_layer(&self) -> Option<usize> {
        self.texts.map(|_| self.places.texts.layer() as usize)
    }

    /// The clip whose segments have the texts, in its own bank: this one as another layer has it, or the original of a dub;
    /// `None` if no layer has any for this clip.
    pub fn texts(&self) -> Option<Clip<'data, 'bank>> {
        self.texts?.clip_at(self.places.texts.slot())
    }

    /// The segment that has the text, and the locale to ask it for.
    #[inline]
    fn asked<'texts, const N: usize>(
        &self,
        segment: u32,
        locale: &LayeredLocale<'texts, N>,
    ) -> Option<(Segment<'data, 'bank>, Locale<'texts>, bool)> {
        let (locale, is_stand_in) = locale.in_layer(self.texts_layer()?)?;
        let is_own = self.places.texts == self.places.clip;
        let segment = if is_own { self.clip.segment(segment) } else { self.texts()?.segment(segment) };
        Some((segment?, locale, is_stand_in))
    }

    /// The display text of the segment with this index in `locale`, or in the locale that it falls back to; `None` if
    /// neither has a text for this clip.
    #[inline]
    pub fn text<'texts, const N: usize>(
        &self,
        segment: u32,
        locale: &LayeredLocale<'texts, N>,
    ) -> Option<Text<'texts>> {
        let (segment, locale, is_stand_in) = self.asked(segment, locale)?;
        let text = segment.text(locale)?;
        Some(if is_stand_in { text.as_fallback() } else { text })
    }

    /// Like [`LayeredClip::text`], as bytes that are not checked to be UTF-8.
    #[inline]
    pub fn text_bytes<'texts, const N: usize>(
        &self,
        segment: u32,
        locale: &LayeredLocale<'texts, N>,
    ) -> Option<&'texts [u8]> {
        let (segment, locale, _) = self.asked(segment, locale)?;
        segment.text_bytes(locale)
    }
}

/// Equal are clips that are equal in their banks and have the same texts.
impl PartialEq for LayeredClip<'_, '_> {
    fn eq(&self, other: &Self) -> bool {
        self.clip == other.clip && self.places == other.places
    }
}
impl Eq for LayeredClip<'_, '_> {}

/// The clip, without its texts.
impl<'data, 'bank> Deref for LayeredClip<'data, 'bank> {
    type Target = Clip<'data, 'bank>;

    fn deref(&self) -> &Clip<'data, 'bank> {
        &self.clip
    }
}
