//! The stack of a dialogue: the files that match each other, and the locations of clips.

use super::file::{BankFile, TextFile};
use super::{Base, Dialogue, DialogueError, FoundClip, Layer};
use crate::set_index::SetIndex;
use crate::{Bank, ClipId, Error, ErrorKind};
use lipz_layout::{LAYER_ARTICULATION, Tag, U64, shard_of};

/// The filter of a patch without a filter: any id may be in the patch.
const ALL_IDS: [U64; 1] = [U64::MAX_VALUE];

/// The location of a clip: a file, and a slot in it.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) struct ClipLocation {
    pub(super) file: u32,
    pub(super) slot: u32,
}

/// The locations of a clip of a stack and of its texts, which are mostly the same.
#[derive(Clone, Copy)]
struct Places {
    clip: Option<ClipLocation>,
    texts: Option<ClipLocation>,
}

/// A bank of the stack, for one clip: the base, the bank of a set that has the clip, or a patch.
#[derive(Clone, Copy)]
pub(super) struct Level<'a> {
    pub(super) number: usize,
    pub(super) file: &'a BankFile<'a>,
    /// A patch's description of the banks below it; `None` for the base, even if it was packed over another bank.
    pub(super) layer: Option<&'a Layer<'a>>,
}

impl<'a> Dialogue<'a> {
    /// Puts a patch on top of the stack.
    pub(super) fn add_patch(&mut self, number: usize, file: &'a BankFile<'a>) -> Result<(), DialogueError> {
        let failed = |kind| DialogueError::new(number, Error::new(kind, 0));
        let layer = file.layer.as_ref().ok_or(failed(ErrorKind::NotALayer))?;
        // Each is searched for above the one before it.
        let mut below = (0..=self.patch_count).filter_map(|level| self.checksum_of_level(level));
        if !layer.bases.iter().all(|base| below.any(|checksum| checksum == base.get())) {
            return Err(failed(ErrorKind::OtherBase));
        }
        match (self.patches.get_mut(self.patch_count), self.filters.get_mut(self.patch_count)) {
            (Some(place), Some(filter)) => {
                *place = Some(file);
                *filter = if layer.filter.is_empty() { &ALL_IDS } else { layer.filter };
            }
            _ => return Err(failed(ErrorKind::LayerCount)),
        }
        self.patch_count = self.patch_count.saturating_add(1).min(Dialogue::MAX_PATCHES);
        self.removes_locales |= layer.removed_locales().next().is_some();
        Ok(())
    }

    /// Returns the checksum of the base, or of the patch at this level.
    fn checksum_of_level(&self, level: usize) -> Option<u64> {
        match level.checked_sub(1) {
            None => Some(self.files.file(0)?.checksum()),
            Some(patch) => Some(self.patch(patch)?.file.bank.checksum()),
        }
    }

    /// Whether a bank before the file with this number contains the clips of these texts. The index of a set answers
    /// for the banks of the set.
    pub(super) fn has_bank_of(&self, number: usize, texts: &TextFile<'_>) -> bool {
        if let Base::Set(index) = &self.base {
            if index.banks().any(|bank| bank.fingerprint == texts.fingerprint()) {
                return true;
            }
        }
        let own = (0..number).filter(|&number| number == 0 || number >= self.behind_base());
        own.filter_map(|number| self.bank_file(number)).any(|file| texts.is_beside(&file.bank))
    }

    /// Returns the patch with this number in the stack, where 0 is the one just above the base.
    pub(super) fn patch(&self, patch: usize) -> Option<Level<'a>> {
        let file = (*self.patches.get(patch)?)?;
        Some(Level { number: file.bank.number as usize, file, layer: file.layer.as_ref() })
    }

    /// Returns the base, or the bank of a set that may have the clip with this id.
    pub(super) fn base_of(&self, id: ClipId) -> Option<Level<'a>> {
        match &self.base {
            Base::Bank(file) => Some(Level { number: 0, file, layer: None }),
            Base::Set(index) => {
                let number = index.bank_of(id).saturating_add(1);
                Some(Level { number, file: self.bank_file(number)?, layer: None })
            }
        }
    }

    /// Returns the banks that may have the clip with this id, from the top.
    pub(super) fn levels_of(&self, id: ClipId) -> impl Iterator<Item = Level<'a>> + '_ {
        let patches = (0..self.patch_count).rev().filter_map(move |patch| self.patch(patch));
        let patches = patches.filter(move |level| level.layer.map_or(false, |layer| layer.may_have(id)));
        // The bank of a set is not opened unless it is needed.
        patches.chain((0..1).filter_map(move |_| self.base_of(id)))
    }

    /// Returns the location of the clip of a set with this id, if no patch has it.
    // A dub that is looked up directly costs a search in the index, because it is in the bank of its original.
    #[inline]
    pub(super) fn find_in_set(&self, index: &SetIndex<'a>, id: ClipId) -> Option<FoundClip<'a>> {
        let number = (shard_of(id.get(), index.bank_count() as u32) as usize).saturating_add(1);
        // Continue even if that bank is missing: a dub may be in a loaded one.
        match self.bank(number).and_then(|bank| Some(FoundClip::new(bank, bank.find(id)?.0, true))) {
            None if index.moved_count() > 0 => self.find_moved(index, id),
            found => found,
        }
    }

    /// Returns the location of the clip with this id, if the index states that it is not in the bank of its id.
    #[cold]
    fn find_moved(&self, index: &SetIndex<'a>, id: ClipId) -> Option<FoundClip<'a>> {
        let bank = self.bank(index.moved_to(id.get())?.saturating_add(1))?;
        Some(FoundClip::new(bank, bank.find(id)?.0, true))
    }

    /// Returns the location of the clip with this id, which a patch may describe.
    #[cold]
    #[inline(never)]
    pub(super) fn find_patched(&self, id: ClipId) -> Option<FoundClip<'a>> {
        let Places { clip, texts } = self.places(id);
        let place = clip?;
        Some(FoundClip::new(self.bank(place.file as usize)?, place.slot, texts == clip))
    }

    /// Returns the clip at this location, with the location of its texts.
    pub(super) fn find_at(&self, file: u32, slot: u32) -> Option<FoundClip<'a>> {
        let bank = self.bank(file as usize)?;
        let id = ClipId::from_u64(bank.keys.get(slot as usize)?.id.get());
        let is_patched = self.patch_count != 0 && self.may_be_patched(id);
        let has_texts = !is_patched || self.places(id).texts == Some(ClipLocation { file, slot });
        Some(FoundClip::new(bank, slot, has_texts))
    }

    /// Returns the locations of the clip with this id and of its texts.
    fn places(&self, id: ClipId) -> Places {
        let mut places = Places { clip: None, texts: None };
        let mut has_texts_of_original = false;
        for Level { number, file, layer } in self.levels_of(id) {
            let slot = match (file.bank.find(id), layer) {
                (Some((slot, _)), _) => slot,
                (None, Some(layer)) if layer.removes(id) => break,
                (None, _) => continue,
            };
            let place = Some(ClipLocation { file: number as u32, slot });
            let (has_clip, has_texts) = layer.map_or((true, true), |layer| layer.parts(slot));
            if has_texts && !has_texts_of_original {
                places.texts = places.texts.or(place);
            }
            if has_clip {
                places.clip = places.clip.or(place);
            }
            let borrows = || layer.map_or(false, |layer| layer.has_texts_of_original(slot));
            has_texts_of_original |= places.texts.is_none() && borrows();
            if places.clip.is_some() && (places.texts.is_some() || has_texts_of_original) {
                break;
            }
        }
        if has_texts_of_original {
            places.texts = self.original_id(id).and_then(|(_, original)| self.own_texts(original));
        }
        places
    }

    /// Returns the number of the bank with the texts of the clip with this id, and the slot there; `None` if no bank
    /// has texts for it. For a dub without its own texts, the slot is that of its original. Texts of a locale can be in
    /// a text bank of that bank. For tools.
    pub fn slot_of_texts(&self, id: ClipId) -> Option<(u32, u32)> {
        self.texts_place(id).map(|place| (place.file, place.slot))
    }

    /// Returns the location of the texts of the clip with this id, if any file has some for it.
    pub(super) fn texts_place(&self, id: ClipId) -> Option<ClipLocation> {
        self.places(id).texts
    }

    /// Returns the location of the clip's own texts, if it has some.
    fn own_texts(&self, id: ClipId) -> Option<ClipLocation> {
        for Level { number, file, layer } in self.levels_of(id) {
            match (file.bank.find(id), layer) {
                (Some((slot, _)), None) => return Some(ClipLocation { file: number as u32, slot }),
                (Some((slot, _)), Some(layer)) if layer.parts(slot).1 => {
                    return Some(ClipLocation { file: number as u32, slot });
                }
                (Some((slot, _)), Some(layer)) if layer.has_texts_of_original(slot) => return None,
                (None, Some(layer)) if layer.removes(id) => return None,
                _ => {}
            }
        }
        None
    }

    /// Returns the number of segments of the clip with this id, from the topmost file that has more of it than texts.
    pub(super) fn segment_count(&self, id: ClipId) -> Option<u32> {
        for Level { file, layer, .. } in self.levels_of(id) {
            match (file.bank.find(id), layer) {
                (Some((slot, _)), layer) if layer.map_or(true, |layer| layer.parts(slot).0) => {
                    return Some(file.bank.clip_at(slot)?.segment_count());
                }
                (None, Some(layer)) if layer.removes(id) => return None,
                _ => {}
            }
        }
        None
    }

    /// Returns the number of the missing bank of a set that would contain the clip with this id, if there is one.
    pub(super) fn missing_bank_in_files(&self, id: ClipId) -> Option<usize> {
        let mut patches = (0..self.patch_count).filter_map(|patch| self.patch(patch)?.layer);
        if patches.any(|layer| layer.removes(id)) {
            return None;
        }
        let number = self.set_index()?.bank_of(id).saturating_add(1);
        if self.bank(number).is_none() { Some(number) } else { None }
    }

    /// Returns the bank that sets the data of a layer flag: the topmost patch with the flag, or the base. For a set,
    /// that is its first loaded bank; for articulation, the first one with phones, because the others lack the targets.
    pub(super) fn bank_with_in_files(&self, flag: u32) -> Option<&'a Bank<'a>> {
        let mut patches = (0..self.patch_count).rev().filter_map(|patch| self.patch(patch));
        match patches.find(|level| level.layer.map_or(false, |layer| layer.has(flag))) {
            Some(level) => Some(&level.file.bank),
            None => {
                let has_targets = |level: &Level<'a>| !level.file.bank.file.section(Tag::ARTICULATION).is_empty();
                let articulated = if flag == LAYER_ARTICULATION { self.base_levels().find(has_targets) } else { None };
                Some(&articulated.or_else(|| self.base_levels().next())?.file.bank)
            }
        }
    }
}
