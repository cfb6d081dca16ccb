//! What a run asks a cache of its files, and what it leaves for the next one.

use super::file_meta::FileMeta;
use super::look::Look;
use super::old_bank::OldBank;
use super::stamps::{Lookup, Name, Stamp, Stamps, hash};
use crate::compile::FileReader;
use crate::{Content, Input};
use std::time::SystemTime;

/// What a run asks for the clips of files that did not change.
pub(crate) struct Cache<'s> {
    /// The stamps of the run before, if its bank is there.
    pub(super) before: Option<Lookup<'s>>,
    pub(super) start: SystemTime,
}

/// A file that was looked at.
pub(crate) struct CachedFile<'c> {
    cache: &'c Cache<'c>,
    name: Name,
    meta: FileMeta,
    /// Its stamp of the run before, which says that its clip is in the old bank.
    known: Option<&'c Stamp>,
}

impl<'s> Cache<'s> {
    pub(super) fn new(stamps: Option<&'s Stamps>, bank: Option<&OldBank>) -> Cache<'s> {
        let is_there = bank.and_then(OldBank::clip_count).is_some();
        Cache { before: stamps.filter(|_| is_there).map(Stamps::lookup), start: SystemTime::now() }
    }

    /// Looks at the file of input number `index`, which `reader` may read next; `None` if it has none, or cannot be looked at.
    pub(crate) fn file<'c>(
        &'c self,
        index: usize,
        input: &'c Input,
        look: &mut Look,
        reader: &mut FileReader,
    ) -> Option<CachedFile<'c>> {
        let Content::File(path) = &input.content else { return None };
        let meta = Look::meta(path, reader)?;
        let name = look.name(path, &input.key);
        let known = self.before.as_ref().and_then(|stamps| stamps.get(name, look.next_stamp(index)));
        Some(CachedFile { cache: self, name, meta, known })
    }
}

impl CachedFile<'_> {
    /// The stamp of the file, if its meta proves that it did not change.
    pub(crate) fn unread(&self) -> Option<Stamp> {
        self.known.filter(|known| known.proves(&self.meta)).copied()
    }

    /// The stamp of the file, which has these contents, and whether it had them before.
    pub(crate) fn read(&self, bytes: &[u8]) -> (Stamp, bool) {
        let contents = hash(bytes);
        let known = self.known.filter(|known| known.has_contents(contents));
        let mut stamp = Stamp::new(self.meta, contents, self.cache.start);
        stamp.mark(known.is_some_and(|known| known.is_marked()));
        (stamp, known.is_some())
    }

    /// The name of the file in a cache.
    pub(crate) fn name(&self) -> Name {
        self.name
    }
}
