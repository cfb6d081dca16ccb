//! What a layer says about the banks below it: the section `LAYR`.

use crate::{Bank, ClipId, Error, ErrorKind};
use lipz_layout::{
    LAYER_BABBLE, LAYER_DEFAULT_LOCALE, LAYER_FACES, LayerRecord, NO_STAND_IN, PART_CLIP, PART_TEXTS, Tag, U32, U64,
};
use zerocopy::{FromBytes, Immutable, KnownLayout, Unaligned};

/// Both parts of a clip.
const WHOLE: u8 = PART_CLIP | PART_TEXTS;

/// The section of a layer, checked; empty for a bank that is none.
#[derive(Clone, Copy)]
pub(crate) struct LayerTable<'data> {
    /// Checksums of the banks that it was made over, the lowest first.
    pub(crate) bases: &'data [U64],
    /// Ids of removed clips in ascending order.
    pub(crate) removed: &'data [U64],
    stand_ins: &'data [U32],
    parts: &'data [u8],
    removed_locales: &'data [u8],
    flags: u32,
}

impl<'data> LayerTable<'data> {
    /// The table of a bank without the section.
    const NONE: LayerTable<'static> =
        LayerTable { bases: &[], removed: &[], stand_ins: &[], parts: &[], removed_locales: &[], flags: 0 };

    /// The table of the bank, if it is a layer. Checks all of it, in a time in proportion to its length.
    pub(crate) fn read(bank: &Bank<'data>) -> Result<LayerTable<'data>, Error> {
        let entry = match bank.file.entry(Tag::LAYER) {
            Some(entry) => entry,
            None => return Ok(LayerTable::NONE),
        };
        let table = bank.file.contents(entry).and_then(LayerTable::cut).filter(|table| table.is_valid(bank));
        table.ok_or(Error::new(ErrorKind::Layer, entry.offset_bytes.get()))
    }

    /// The parts of a section, as long as it says.
    fn cut(section: &'data [u8]) -> Option<LayerTable<'data>> {
        let (record, rest) = LayerRecord::ref_from_prefix(section).ok()?;
        let (bases, rest) = take(rest, record.base_count)?;
        let (removed, rest) = take(rest, record.removed_count)?;
        let (stand_ins, rest) = take(rest, record.stand_in_count)?;
        let (parts, removed_locales) = take(rest, record.part_count)?;
        let flags = record.flags.get();
        let table = LayerTable { bases, removed, stand_ins, parts, removed_locales, flags };
        let mut count = 0_u32;
        let mut rest = removed_locales;
        let mut before: &[u8] = &[];
        while let Some((tag, behind)) = split_tag(rest) {
            if tag <= before || core::str::from_utf8(tag).is_err() {
                return None;
            }
            before = tag;
            rest = behind;
            count = count.saturating_add(1);
        }
        if rest.is_empty() && count == record.removed_locale_count.get() { Some(table) } else { None }
    }

    /// Whether the table fits its bank.
    fn is_valid(&self, bank: &Bank<'_>) -> bool {
        let locale_count = bank.texts.records.len();
        let is_locale = |stand_in: &U32| stand_in.get() == NO_STAND_IN || (stand_in.get() as usize) < locale_count;
        let mut before = None;
        let is_removed = |id: &U64| {
            let follows = before.map_or(true, |before| before < id.get());
            before = Some(id.get());
            follows && bank.find(ClipId::from_u64(id.get())).is_none()
        };
        !self.bases.is_empty()
            && self.flags & !(LAYER_BABBLE | LAYER_DEFAULT_LOCALE | LAYER_FACES) == 0
            && self.removed.iter().all(is_removed)
            && (self.stand_ins.is_empty() || self.stand_ins.len() == locale_count)
            && self.stand_ins.iter().all(is_locale)
            && (self.parts.is_empty() || self.parts.len() == bank.clips.len())
            && self.parts.iter().all(|part| (PART_CLIP..=WHOLE).contains(part))
            && bank.locales().all(|locale| !self.removes_locale(locale.tag()))
    }

    /// Whether the clip in this slot has frames and events here, and whether it has its texts here.
    #[inline]
    pub(crate) fn parts(&self, slot: u32) -> (bool, bool) {
        let parts = self.parts.get(slot as usize).copied().unwrap_or(WHOLE);
        (parts & PART_CLIP != 0, parts & PART_TEXTS != 0)
    }

    /// Whether the layer removes the clip with this id from the banks below.
    #[inline]
    pub(crate) fn removes(&self, id: ClipId) -> bool {
        !self.removed.is_empty() && self.lists(id)
    }

    #[inline(never)] // few layers remove clips
    fn lists(&self, id: ClipId) -> bool {
        self.removed.binary_search_by(|removed| removed.get().cmp(&id.get())).is_ok()
    }

    /// Whether the layer removes the locale with this tag from the banks below.
    pub(crate) fn removes_locale(&self, tag: &str) -> bool {
        self.removed_locales().any(|removed| removed == tag)
    }

    /// The tags of the locales that the layer removes.
    pub(crate) fn removed_locales(&self) -> impl Iterator<Item = &'data str> {
        let mut rest = self.removed_locales;
        core::iter::from_fn(move || {
            let (tag, behind) = split_tag(rest)?;
            rest = behind;
            core::str::from_utf8(tag).ok()
        })
    }

    /// The index of the layer's locale that stands in for the one with this index in banks below that do not have that.
    pub(crate) fn stand_in(&self, locale: usize) -> Option<usize> {
        self.stand_ins.get(locale).map(|stand_in| stand_in.get() as usize)
    }

    /// Whether what this flag is about counts as the layer has it: [`LAYER_BABBLE`] and so on.
    pub(crate) fn has(&self, flag: u32) -> bool {
        self.flags & flag != 0
    }
}

/// So many entries at the start of `bytes`, and what is behind them.
fn take<T>(bytes: &[u8], count: U32) -> Option<(&[T], &[u8])>
where
    T: FromBytes + Immutable + KnownLayout + Unaligned,
{
    <[T]>::ref_from_prefix_with_elems(bytes, count.get() as usize).ok()
}

/// The first tag of a list, after its length in a byte, and what is behind it.
fn split_tag(list: &[u8]) -> Option<(&[u8], &[u8])> {
    let (length, rest) = list.split_first()?;
    let tag = rest.get(..usize::from(*length))?;
    Some((tag, rest.get(tag.len()..)?))
}
