//! All clips of a dialogue.

use super::Dialogue;
use crate::clip::Clips;
use crate::{Bank, Clip};

/// A position in the clips of a dialogue, as numbers that a struct of another language can hold.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub(super) struct ClipWalk {
    file: u32,
    /// How many clips of the file have been passed.
    passed: u32,
}

impl<'a> Dialogue<'a> {
    /// Returns all clips, each once, except those that a patch removes: file by file, and ordered by key in each. In a
    /// dialogue of one bank, all keys are in order.
    pub fn clips(&self) -> impl Iterator<Item = Clip<'_>> + '_ {
        self.clips_under("")
    }

    /// Returns the clips whose keys start with `prefix`, in the same order. `act1/` selects those of a folder.
    pub fn clips_under<'p>(&'p self, prefix: &'p str) -> impl Iterator<Item = Clip<'p>> + 'p {
        let mut walk = ClipWalk::default();
        core::iter::from_fn(move || self.next_clip(&mut walk, prefix))
    }

    /// Returns the next clip after `position` whose key starts with `prefix`, and the position after it. Start with 0.
    /// This is [`Dialogue::clips_under`] for programs that cannot keep an iterator.
    pub fn clip_behind(&self, position: u64, prefix: &str) -> Option<(Clip<'_>, u64)> {
        let mut walk = ClipWalk { file: (position >> 32) as u32, passed: position as u32 };
        let clip = self.next_clip(&mut walk, prefix)?;
        Some((clip, u64::from(walk.file) << 32 | u64::from(walk.passed)))
    }

    fn next_clip(&self, walk: &mut ClipWalk, prefix: &str) -> Option<Clip<'_>> {
        while (walk.file as usize) < self.files.count() {
            if let Some(bank) = self.bank(walk.file as usize) {
                for clip in under(bank, prefix, walk.passed) {
                    walk.passed = walk.passed.saturating_add(1);
                    // A file above may replace or remove the clip. If it only has texts, the clip itself is in a file
                    // below.
                    let top = self.clip(clip.id());
                    if let Some(top) = top.filter(|top| top.file() == walk.file && top.slot() == clip.slot()) {
                        return Some(top);
                    }
                }
            }
            *walk = ClipWalk { file: walk.file.saturating_add(1), passed: 0 };
        }
        None
    }

    /// Returns the number of clips. Counts them if there are patches.
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

/// Returns the clips of a bank whose keys start with `prefix`, after the first `passed`.
fn under<'b>(bank: &'b Bank<'b>, prefix: &str, passed: u32) -> Clips<'b> {
    bank.clips_from(prefix).behind(passed as usize)
}
