//! A layer's description of the banks below it: the section `LAYR`.

use crate::{Bank, ClipId, Error, ErrorKind};
use core::fmt;
use lipz_layout::{
    LAYER_ARTICULATION, LAYER_BABBLE, LAYER_DEFAULT_LOCALE, LAYER_FACES, LAYER_FLAGS, LAYER_RIGS, LAYER_VOICES,
    LayerDubRecord, LayerRecord, NO_STAND_IN, PART_CLIP, PART_ORIGINAL, PART_TEXTS, Tag, U32, U64,
};
use zerocopy::{FromBytes, Immutable, KnownLayout, Unaligned};

/// Both parts of a clip.
const WHOLE: u8 = PART_CLIP | PART_TEXTS;

/// A layer's description of the banks below it.
///
/// A [`Dialogue`](crate::Dialogue) evaluates it. Only tools use it directly.
#[derive(Clone, Copy)]
pub struct Layer<'data> {
    /// Checksums of the banks that it was packed over, the lowest first.
    pub(super) bases: &'data [U64],
    /// Bits of the ids that the layer describes; empty if they are not known.
    pub(super) filter: &'data [U64],
    /// Ids of removed clips in ascending order.
    removed: &'data [U64],
    /// The dubs, in ascending order of the ids of the clips, and of the voices.
    pub(super) dubs: &'data [LayerDubRecord],
    /// Slot and locale number of each text of a dub that is also the text of its original, in ascending order.
    borrowed: &'data [U64],
    stand_ins: &'data [U32],
    parts: &'data [u8],
    voices: &'data [u8],
    removed_locales: &'data [u8],
    removed_locale_count: u32,
    flags: u32,
}

impl<'data> Bank<'data> {
    /// Returns the description of the banks below; `None` if the bank is not a layer. Only the lengths of its tables
    /// are checked: see [`Bank::verified_layer`].
    pub fn layer(&self) -> Option<Layer<'data>> {
        Layer::cut(self.file.contents(self.file.entry(Tag::LAYER)?)?)
    }

    /// Returns the same, checked in a time in proportion to its length, as
    /// [`DialogueFile::open`](crate::files::DialogueFile::open) checks it. [`Bank::verify`] skips this check, so that
    /// programs without layers do not contain the code.
    ///
    /// # Errors
    /// [`ErrorKind::Layer`] if it is cut off, out of order, or refers to missing data.
    pub fn verified_layer(&self) -> Result<Option<Layer<'data>>, Error> {
        let entry = match self.file.entry(Tag::LAYER) {
            Some(entry) => entry,
            None => return Ok(None),
        };
        let layer = self.layer().filter(|layer| layer.is_valid(self));
        layer.map(Some).ok_or(Error::new(ErrorKind::Layer, entry.offset_bytes.get()))
    }
}

impl<'data> Layer<'data> {
    /// An empty description.
    const NONE: Layer<'static> = Layer {
        bases: &[],
        filter: &[],
        removed: &[],
        dubs: &[],
        borrowed: &[],
        stand_ins: &[],
        parts: &[],
        voices: &[],
        removed_locales: &[],
        removed_locale_count: 0,
        flags: 0,
    };

    /// Splits a section into its parts; `None` if it is too short.
    fn cut(section: &'data [u8]) -> Option<Layer<'data>> {
        let (record, rest) = LayerRecord::ref_from_prefix(section).ok()?;
        let (bases, rest) = take(rest, record.base_count)?;
        let (filter, rest) = take(rest, record.filter_count)?;
        let (removed, rest) = take(rest, record.removed_count)?;
        let (dubs, rest) = take(rest, record.dub_count)?;
        let (borrowed, rest) = take(rest, record.borrowed_count)?;
        let (stand_ins, rest) = take(rest, record.stand_in_count)?;
        let (parts, tags) = take(rest, record.part_count)?;
        let mut removed_locales = tags;
        for _ in 0..record.voice_count.get() {
            (_, removed_locales) = split_tag(removed_locales)?;
        }
        let voices = tags.get(..tags.len().checked_sub(removed_locales.len())?)?;
        let (removed_locale_count, flags) = (record.removed_locale_count.get(), record.flags.get());
        let layer =
            Layer { bases, filter, removed, dubs, borrowed, stand_ins, parts, voices, removed_locales, ..Layer::NONE };
        Some(Layer { removed_locale_count, flags, ..layer })
    }

    /// Whether the tags of removed locales ascend, have the right number, and fill their table.
    fn has_valid_tags(&self) -> bool {
        ascending(self.removed_locales) == Some(self.removed_locale_count)
    }

    /// Whether the first voice is the original's, the others ascend, and the dubs refer to these voices.
    fn has_valid_voices(&self, bank: &Bank<'_>) -> bool {
        let (original, others) = split_tag(self.voices).unwrap_or_default();
        let count = ascending(others);
        let mut before = None;
        let is_dub = |dub: &LayerDubRecord| {
            let place = Some((dub.clip_id.get(), dub.voice.get()));
            let follows = before < place;
            before = place;
            let is_voice = dub.voice.get() > 0 && Some(u32::from(dub.voice.get())) <= count;
            follows && is_voice && super::voices::is_entry(dub)
        };
        let mut before_borrowed = None;
        let is_text = |place: &U64| {
            let follows = before_borrowed < Some(place.get());
            before_borrowed = Some(place.get());
            let (slot, locale) = (place.get() >> 32, place.get() as u32);
            follows && (slot as usize) < bank.clips.len() && (locale as usize) < bank.texts.records.len()
        };
        count.is_some()
            && original.is_empty() == (count == Some(0))
            && core::str::from_utf8(original).is_ok()
            && self.voices().skip(1).all(|voice| voice.as_bytes() != original)
            && self.dubs.iter().all(is_dub)
            && self.borrowed.iter().all(is_text)
    }

    /// Whether the table is consistent with its bank.
    fn is_valid(&self, bank: &Bank<'_>) -> bool {
        let locale_count = bank.texts.records.len();
        let is_locale = |stand_in: &U32| stand_in.get() == NO_STAND_IN || (stand_in.get() as usize) < locale_count;
        let mut before = None;
        let is_removed = |id: &U64| {
            let follows = before.map_or(true, |before| before < id.get());
            before = Some(id.get());
            follows && bank.find(ClipId::from_u64(id.get())).is_none()
        };
        let is_filtered = |id| self.may_have(id);
        !self.bases.is_empty()
            && self.has_valid_tags()
            && self.has_valid_voices(bank)
            && self.flags & !LAYER_FLAGS == 0
            && self.removed.iter().all(is_removed)
            && (self.filter.is_empty() || self.filter.len().is_power_of_two())
            && self.removed_clips().chain(bank.keys.iter().map(|key| ClipId::from_u64(key.id.get()))).all(is_filtered)
            && (self.stand_ins.is_empty() || self.stand_ins.len() == locale_count)
            && self.stand_ins.iter().all(is_locale)
            && (self.parts.is_empty() || self.parts.len() == bank.clips.len())
            && self.parts.iter().all(|part| (PART_CLIP..=PART_CLIP | PART_ORIGINAL).contains(part))
            && (0..locale_count).all(|index| bank.texts.tag(index).map_or(true, |tag| !self.removes_locale(tag)))
    }

    /// Returns the checksums of the banks that it was packed over, the lowest first.
    pub fn made_over(&self) -> impl Iterator<Item = u64> + 'data {
        self.bases.iter().map(|base| base.get())
    }

    /// Returns the ids of the clips that it removes from the banks below, in ascending order.
    pub fn removed_clips(&self) -> impl Iterator<Item = ClipId> + 'data {
        self.removed.iter().map(|id| ClipId::from_u64(id.get()))
    }

    /// Whether the layer contains the visemes, events and curves of the clip in this slot, and whether it contains its
    /// texts. The missing part is in a bank below.
    #[inline]
    pub fn parts(&self, slot: u32) -> (bool, bool) {
        let parts = self.parts.get(slot as usize).copied().unwrap_or(WHOLE);
        (parts & PART_CLIP != 0, parts & PART_TEXTS != 0)
    }

    /// Whether the clip in this slot is a dub that uses the texts of its original in the stack.
    pub fn has_texts_of_original(&self, slot: u32) -> bool {
        self.parts.get(slot as usize).map_or(false, |parts| parts & PART_ORIGINAL != 0)
    }

    /// Whether the text of the clip in this slot, in the locale at this place, is that of its original. The clip is a
    /// dub that has other texts of its own.
    pub fn borrows(&self, slot: u32, locale: usize) -> bool {
        let place = u64::from(slot) << 32 | locale as u64;
        self.borrowed.binary_search_by(|text| text.get().cmp(&place)).is_ok()
    }

    /// Returns the tags of voices, that of the originals first: the added ones, or all voices of the stack if
    /// [`has_voices`](Layer::has_voices) is set.
    pub fn voices(&self) -> impl Iterator<Item = &'data str> {
        tags(self.voices)
    }

    /// Whether its list of voices, even if empty, replaces the one below.
    pub fn has_voices(&self) -> bool {
        self.has(LAYER_VOICES)
    }

    /// Returns the number of clips and voices for which the layer states the dub.
    pub fn dub_count(&self) -> usize {
        self.dubs.len()
    }

    /// Whether the layer may describe the clip with this id; `false` if it certainly does not.
    #[inline]
    pub fn may_have(&self, id: ClipId) -> bool {
        may_have(self.filter, id)
    }

    /// Whether the layer removes the clip with this id from the banks below.
    #[inline]
    pub fn removes(&self, id: ClipId) -> bool {
        !self.removed.is_empty() && self.lists(id)
    }

    #[inline(never)] // few layers remove clips
    fn lists(&self, id: ClipId) -> bool {
        self.removed.binary_search_by(|removed| removed.get().cmp(&id.get())).is_ok()
    }

    /// Whether the layer removes the locale with this tag from the banks below.
    pub fn removes_locale(&self, tag: &str) -> bool {
        self.removed_locales().any(|removed| removed == tag)
    }

    /// Returns the tags of the locales that the layer removes.
    pub fn removed_locales(&self) -> impl Iterator<Item = &'data str> {
        tags(self.removed_locales)
    }

    /// Returns the place of the locale that replaces the one at this place in banks below that do not have it. Places
    /// are those in [`Bank::locales`].
    pub fn stand_in(&self, locale: usize) -> Option<usize> {
        self.stand_ins.get(locale).map(|stand_in| stand_in.get() as usize)
    }

    /// Whether the layer replaces the data of this flag: [`LAYER_BABBLE`] and so on.
    pub(crate) fn has(&self, flag: u32) -> bool {
        self.flags & flag != 0
    }

    /// Whether its babble profiles, even if empty, replace those below.
    pub fn has_babble(&self) -> bool {
        self.has(LAYER_BABBLE)
    }

    /// Whether its face profiles, even if empty, replace those below.
    pub fn has_faces(&self) -> bool {
        self.has(LAYER_FACES)
    }

    /// Whether it replaces the articulation profiles below it.
    pub fn has_articulation(&self) -> bool {
        self.has(LAYER_ARTICULATION)
    }

    /// Whether it replaces the rigs below it.
    pub fn has_rigs(&self) -> bool {
        self.has(LAYER_RIGS)
    }

    /// Whether its default locale, even if unset, replaces the one below.
    pub fn has_default_locale(&self) -> bool {
        self.has(LAYER_DEFAULT_LOCALE)
    }
}

/// Whether a filter accepts an id. An empty filter accepts all of them.
#[inline]
pub(super) fn may_have(filter: &[U64], id: ClipId) -> bool {
    let (word, bit) = lipz_layout::filter_place(id.get(), filter.len());
    filter.get(word).map_or(true, |word| word.get() >> bit & 1 != 0)
}

/// Splits `count` entries off the start of `bytes`.
fn take<T>(bytes: &[u8], count: U32) -> Option<(&[T], &[u8])>
where
    T: FromBytes + Immutable + KnownLayout + Unaligned,
{
    <[T]>::ref_from_prefix_with_elems(bytes, count.get() as usize).ok()
}

/// Returns the tags of a list.
fn tags(mut rest: &[u8]) -> impl Iterator<Item = &str> {
    core::iter::from_fn(move || {
        let (tag, behind) = split_tag(rest)?;
        rest = behind;
        core::str::from_utf8(tag).ok()
    })
}

/// Returns the number of tags in a list, if they ascend and fill it.
fn ascending(mut rest: &[u8]) -> Option<u32> {
    let mut count = 0_u32;
    let mut before: &[u8] = &[];
    while let Some((tag, behind)) = split_tag(rest) {
        if tag <= before || core::str::from_utf8(tag).is_err() {
            return None;
        }
        before = tag;
        rest = behind;
        count = count.saturating_add(1);
    }
    if rest.is_empty() { Some(count) } else { None }
}

/// Splits off the first tag of a list, which follows its length in one byte.
fn split_tag(list: &[u8]) -> Option<(&[u8], &[u8])> {
    let (length, rest) = list.split_first()?;
    let tag = rest.get(..usize::from(*length))?;
    Some((tag, rest.get(tag.len()..)?))
}

/// Prints the effects of the layer as counts.
impl fmt::Debug for Layer<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Layer")
            .field("made_over", &self.bases.len())
            .field("removed_clips", &self.removed.len())
            .field("removed_locales", &self.removed_locale_count)
            .finish_non_exhaustive()
    }
}
