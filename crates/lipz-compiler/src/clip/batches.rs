//! The clips that a thread makes.

use super::{ClipData, Clips, Locales};

/// Clips in as few batches as there is room for: mostly in one. More of them, and smaller ones, would leave more memory with the
/// allocator.
#[derive(Debug, Default)]
pub(crate) struct Batches {
    full: Vec<Clips>,
    last: Clips,
}

impl Batches {
    /// The locales that the texts of the next clip refer to by number.
    pub(crate) fn locales(&mut self) -> &mut Locales {
        &mut self.last.locales
    }

    /// Adds a clip.
    pub(crate) fn push(&mut self, key: &str, clip: &ClipData) {
        if !self.last.has_room_for(clip) {
            // Its locales have the same numbers.
            let next = Clips::of_locales(self.last.locales.clone());
            self.full.push(std::mem::replace(&mut self.last, next));
        }
        self.last.push(key, clip);
    }

    /// All batches.
    pub(crate) fn into_all(mut self) -> Vec<Clips> {
        self.full.push(self.last);
        self.full
    }
}
