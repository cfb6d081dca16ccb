//! All clips of a dialogue.

use super::Dialogue;
use crate::clip::Clips;
use crate::{Bank, Clip};

/// Where a walk through the clips of a dialogue is: numbers to keep in a struct of another language.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub(super) struct Walk {
    file: u32,
    /// How many clips of the file it has passed.
    passed: u32,
}

impl<'a> Dialogue<'a> {
    /// All clips, each once, without those that a patch removes: file by file, in each in the order of their keys. In a dialogue
    /// of one bank that is the order of all keys.
    pub fn clips(&self) -> impl Iterator<Item = Clip<'_>> + '_ {
        self.clips_under("")
    }

    /// The clips whose keys start with `prefix`, in the same order: `act1/` gives those of a folder.
    pub fn clips_under<'p>(&'p self, prefix: &'p str) -> impl Iterator<Item = Clip<'p>> + 'p {
        let mut walk = Walk::default();
        core::iter::from_fn(move || self.next_clip(&mut walk, prefix))
    }

    /// The clip behind those that `position` has passed, among those whose keys start with `prefix`, and the position behind it:
    /// [`Dialogue::clips_under`] for programs that cannot keep an iterator. Start with 0.
    pub fn clip_behind(&self, position: u64, prefix: &str) -> Option<(Clip<'_>, u64)> {
        let mut walk = Walk { file: (position >> 32) as u32, passed: position as u32 };
        let clip = self.next_clip(&mut walk, prefix)?;
        Some((clip, u64::from(walk.file) << 32 | u64::from(walk.passed)))
    }

    fn next_clip(&self, walk: &mut Walk, prefix: &str) -> Option<Clip<'_>> {
        while (walk.file as usize) < self.files.count() {
            if let Some(bank) = self.bank(walk.file as usize) {
                for clip in under(bank, prefix, walk.passed) {
                    walk.passed = walk.passed.saturating_add(1);
                    // A file above may have the clip, or remove it, and of texts alone the clip is below.
                    let top = self.clip(clip.id());
                    if let Some(top) = top.filter(|top| top.file() == walk.file && top.slot() == clip.slot()) {
                        return Some(top);
                    }
                }
            }
            *walk = Walk { file: walk.file.saturating_add(1), passed: 0 };
        }
        None
    }

    /// The number of clips; counts them if there are patches.
    pub fn clip_count(&self) -> usize {
        match self.patch_count {
            0 => match self.set_index() {
                Some(index) => usize::try_from(index.clip_count()).unwrap_or(usize::MAX),
                None => self.bank(0).map_or(0, Bank::clip_count),
            },
            _ => self.clips().count(),
        }
    }
}

/// The clips of a bank whose keys start with `prefix`, behind those that were passed.
fn under<'b>(bank: &'b Bank<'b>, prefix: &str, passed: u32) -> Clips<'b> {
    bank.clips_from(prefix).behind(passed as usize)
}
