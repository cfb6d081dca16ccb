//! A clip of a stack: what the topmost layer that has it says.

use super::LayeredLocale;
use crate::{Clip, Text};
use core::ops::Deref;

/// A clip of [`Layers`](crate::Layers): the [`Clip`] of the topmost layer that has it, and its texts.
///
/// It is used as a `Clip`, with a [`Cursor`](crate::Cursor), too. Only texts are asked for here, because another layer
/// may have them: a dub has mouth shapes of its own, and the texts of the bank below it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct LayeredClip<'data, 'bank> {
    clip: Clip<'data, 'bank>,
    layer: usize,
    /// The clip whose segments have the texts, and its layer.
    texts: Option<(Clip<'data, 'bank>, usize)>,
}

impl<'data, 'bank> LayeredClip<'data, 'bank> {
    pub(super) fn new(
        clip: Clip<'data, 'bank>,
        layer: usize,
        texts: Option<(Clip<'data, 'bank>, usize)>,
    ) -> LayeredClip<'data, 'bank> {
        LayeredClip { clip, layer, texts }
    }

    /// The clip in its own bank.
    #[inline]
    pub const fn clip(&self) -> &Clip<'data, 'bank> {
        &self.clip
    }

    /// Index of the layer whose mouth shapes, segments, events and curves these are; 0 for the base.
    pub const fn layer(&self) -> usize {
        self.layer
    }

    /// Index of the layer whose texts these are; `None` if no layer has any for this clip.
    pub fn texts_layer(&self) -> Option<usize> {
        Some(self.texts?.1)
    }

    /// The clip whose segments have the texts, in its own bank; `None` if no layer has any for this clip.
    pub fn texts(&self) -> Option<&Clip<'data, 'bank>> {
        Some(&self.texts.as_ref()?.0)
    }

    /// The display text of the segment with this index in `locale`, or in the locale that it falls back to; `None` if
    /// neither has a text for this clip.
    #[inline]
    pub fn text<'texts, const N: usize>(
        &self,
        segment: u32,
        locale: &LayeredLocale<'texts, N>,
    ) -> Option<Text<'texts>> {
        let (clip, layer) = self.texts.as_ref()?;
        let (locale, is_stand_in) = locale.in_layer(*layer)?;
        let text = clip.segment(segment)?.text(locale)?;
        Some(if is_stand_in { text.as_fallback() } else { text })
    }

    /// Like [`LayeredClip::text`], as bytes that are not checked to be UTF-8.
    #[inline]
    pub fn text_bytes<'texts, const N: usize>(
        &self,
        segment: u32,
        locale: &LayeredLocale<'texts, N>,
    ) -> Option<&'texts [u8]> {
        let (clip, layer) = self.texts.as_ref()?;
        clip.segment(segment)?.text_bytes(locale.in_layer(*layer)?.0)
    }
}

impl<'data, 'bank> Deref for LayeredClip<'data, 'bank> {
    type Target = Clip<'data, 'bank>;

    fn deref(&self) -> &Clip<'data, 'bank> {
        &self.clip
    }
}
