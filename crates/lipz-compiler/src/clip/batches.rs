//! The clips made by one thread.

use super::{ClipData, Clips, Locales};

/// Clips in as few batches as possible, usually one. More and smaller ones would leave more memory with the allocator.
#[derive(Debug, Default)]
pub(crate) struct Batches {
    full: Vec<Clips>,
    last: Clips,
}

impl Batches {
    /// Returns the locales that the texts of the next clip refer to by number.
    pub(crate) fn locales(&mut self) -> &mut Locales {
        &mut self.last.locales
    }

    /// Adds a clip.
    pub(crate) fn push(&mut self, key: &str, clip: &ClipData) {
        if !self.last.has_room_for(clip) {
            // The locales keep their numbers.
            let next = Clips::of_locales(self.last.locales.clone());
            self.full.push(std::mem::replace(&mut self.last, next));
        }
        self.last.push(key, clip);
    }

    /// Returns all batches.
    pub(crate) fn into_all(mut self) -> Vec<Clips> {
        self.full.push(self.last);
        self.full
    }
}
