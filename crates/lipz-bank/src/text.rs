//! Display texts, and their positions in the pool.

use crate::pool::Pool;
use core::fmt;
use core::ops::Deref;
use lipz_layout::{TEXT_COUNT_BYTES, TEXT_FALLBACK, TEXT_HAS_LENGTH, TEXT_MAX_BYTES, TEXT_OFFSET, U32, counted_length};

/// A display text.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Text<'data> {
    text: &'data str,
    is_fallback: bool,
}

impl<'data> Text<'data> {
    /// Returns the text as players see it: trimmed, without `{meta}`.
    pub const fn as_str(self) -> &'data str {
        self.text
    }

    /// Whether the locale has no text for this clip, so that this is the text of its fallback locale.
    pub const fn is_fallback(self) -> bool {
        self.is_fallback
    }
}

impl Deref for Text<'_> {
    type Target = str;

    fn deref(&self) -> &str {
        self.text
    }
}

impl AsRef<str> for Text<'_> {
    fn as_ref(&self) -> &str {
        self.text
    }
}

impl fmt::Display for Text<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.text)
    }
}

/// A text that was found: its position, and the pool of the position.
#[derive(Clone, Copy)]
pub(crate) struct FoundText<'a> {
    pub(crate) place: TextPlace,
    pub(crate) texts: &'a Pool<'a>,
}

impl<'a> FoundText<'a> {
    #[inline(always)]
    pub(crate) fn text(&self) -> Option<Text<'a>> {
        let TextPlace { start, end, is_fallback } = self.place;
        Some(Text { text: self.texts.text(start, end)?, is_fallback })
    }

    #[inline(always)]
    pub(crate) fn bytes(&self) -> Option<&'a [u8]> {
        self.texts.slice(self.place.start, self.place.end)
    }

    /// Returns the same text, marked as a fallback if `stands_in`.
    pub(crate) fn marked(mut self, stands_in: bool) -> FoundText<'a> {
        self.place.is_fallback |= stands_in;
        self
    }
}

/// The position of a text in the pool.
#[derive(Clone, Copy)]
pub(crate) struct TextPlace {
    start: usize,
    end: usize,
    is_fallback: bool,
}

impl TextPlace {
    /// Returns the position of the text with this entry, followed by `next`. Returns `None` or an empty range if there
    /// is no text. A damaged entry may lead to another text.
    #[inline(always)]
    pub(crate) fn between(entry: U32, next: U32, texts: Pool<'_>) -> Option<TextPlace> {
        let (entry, next) = (entry.get(), next.get());
        let offset = (entry & TEXT_OFFSET) as usize;
        let (start, end) = if entry & TEXT_HAS_LENGTH == 0 {
            (offset, (next & TEXT_OFFSET) as usize)
        } else {
            let start = offset.wrapping_add(TEXT_COUNT_BYTES);
            (start, start.wrapping_add(length_at(texts.bytes(), offset)?))
        };
        Some(TextPlace { start, end, is_fallback: entry & TEXT_FALLBACK != 0 })
    }

    /// Whether the text comes from another locale.
    pub(crate) const fn is_fallback(&self) -> bool {
        self.is_fallback
    }

    /// Whether the position is in the pool, and no longer than a text may be.
    pub(crate) fn fits(&self, texts: Pool<'_>) -> bool {
        texts.slice(self.start, self.end).map_or(false, |text| text.len() <= TEXT_MAX_BYTES)
    }

    /// Whether the position also contains a string.
    pub(crate) fn is_valid(&self, texts: Pool<'_>) -> bool {
        texts.text(self.start, self.end).map_or(false, |text| text.len() <= TEXT_MAX_BYTES)
    }
}

/// Returns the length of the text after the count at `offset`. If there is no text, that is past the end of the pool.
#[inline(never)] // few texts have a count
fn length_at(pool: &[u8], offset: usize) -> Option<usize> {
    Some(counted_length(pool.get(offset..offset.wrapping_add(TEXT_COUNT_BYTES))?))
}
