//! Display texts as they lie in a bank.

use lipz_bank::layout::{ClipRecord, NO_TEXT, TEXT_OFFSET, Tag, U16, U32};
use lipz_bank::{Bank, Clip};
use zerocopy::FromBytes;

/// The sections of a bank that its texts lie in.
pub(crate) struct BankTexts<'b> {
    clips: &'b [ClipRecord],
    index: &'b [U32],
    /// An entry, then for each locale in turn one per segment.
    ends: &'b [U16],
    pool: &'b [u8],
    segment_count: usize,
}

/// The length of the texts with these ends, which are stored modulo 2^16: as a reader adds them up.
fn length_of(ends: &[U16]) -> usize {
    ends.iter().fold(0, |end, low| end + usize::from(low.get().wrapping_sub(end as u16)))
}

/// The texts of a clip in one locale.
pub(crate) struct InBank<'b> {
    /// The entry of the text index.
    pub(crate) entry: u32,
    /// Where each text ends, modulo 2^16.
    pub(crate) ends: &'b [U16],
    pub(crate) texts: &'b [u8],
}

impl<'b> BankTexts<'b> {
    /// The sections of `bank`.
    pub(crate) fn of(bank: &Bank<'b>) -> Option<BankTexts<'b>> {
        let section = |tag| bank.sections().find(|(found, _)| *found == tag).map(|(_, contents)| contents);
        Some(BankTexts {
            clips: <[ClipRecord]>::ref_from_bytes(section(Tag::CLIPS)?).ok()?,
            index: <[U32]>::ref_from_bytes(section(Tag::TEXT_INDEX)?).ok()?,
            ends: <[U16]>::ref_from_bytes(section(Tag::TEXT_ENDS)?).ok()?,
            pool: section(Tag::TEXTS)?,
            segment_count: (section(Tag::STARTS)?.len() / size_of::<U32>()).checked_sub(1)?,
        })
    }

    /// The entries of the text index for the locale with this number, one per slot.
    pub(crate) fn entries(&self, locale: usize) -> Option<&'b [U32]> {
        self.index.chunks(self.clips.len().max(1)).nth(locale)
    }

    /// The text ends of the locale with this number, one per segment.
    pub(crate) fn ends(&self, locale: usize) -> Option<&'b [U16]> {
        let start = 1 + locale * self.segment_count;
        self.ends.get(start..start + self.segment_count)
    }

    /// The texts of `clip` in the locale with this number; `None` if there are none, or they are damaged.
    pub(crate) fn of_clip(&self, clip: &Clip<'_, '_>, locale: usize) -> Option<InBank<'b>> {
        let slot = clip.slot() as usize;
        let entry = self.entries(locale)?.get(slot)?.get();
        if entry == NO_TEXT {
            return None;
        }
        let first = self.clips.get(slot)?.segments_first.get() as usize;
        let ends = self.ends(locale)?.get(first..first + clip.segment_count() as usize)?;
        let texts = self.pool.get((entry & TEXT_OFFSET) as usize..)?.get(..length_of(ends))?;
        Some(InBank { entry, ends, texts })
    }
}
