//! Answers of a cache about files, and the stamps for the next run.

use super::file_stamps::FileStamps;
use super::old_bank::OldBank;
use super::scratch::Scratch;
use super::stamps::{CacheFileName, Lookup, Stamp, Stamps, hash};
use crate::files::{FileMeta, FileReader};
use crate::run::compile::{EarlierFiles, EarlierRun, RecalledClip};
use crate::sources::{Content, Input};
use std::sync::{Mutex, PoisonError};
use std::time::SystemTime;

/// The clips of unchanged files, for the queries of a run.
pub(super) struct Cache<'s> {
    /// The stamps of the previous run, if its bank is available.
    before: Option<Lookup<'s>>,
    start: SystemTime,
    /// The stamps from finished threads for the next run.
    stamps: Mutex<FileStamps>,
}

/// The queries of one thread, and its stamps for the next run.
struct CachedFiles<'c> {
    cache: &'c Cache<'c>,
    scratch: Scratch,
    /// The file examined last, if it can have a stamp.
    file: Option<CachedFile<'c>>,
    stamps: FileStamps,
}

/// An examined file.
struct CachedFile<'c> {
    index: u32,
    name: CacheFileName,
    meta: FileMeta,
    /// Its stamp from the previous run, which proves that its clip is in the old bank.
    known: Option<&'c Stamp>,
    /// Its new stamp; `None` until it is read.
    stamp: Option<Stamp>,
}

impl<'s> Cache<'s> {
    pub(super) fn new(stamps: Option<&'s Stamps>, bank: Option<&OldBank>) -> Cache<'s> {
        let is_there = bank.and_then(OldBank::clip_count).is_some();
        Cache::of(stamps.filter(|_| is_there).map(Stamps::lookup))
    }

    /// Creates a cache with these stamps of the previous run.
    pub(super) fn of(before: Option<Lookup<'s>>) -> Cache<'s> {
        Cache { before, start: SystemTime::now(), stamps: Mutex::default() }
    }

    /// Sets a different start time of the run.
    #[cfg(test)]
    pub(super) fn started_at(self, start: SystemTime) -> Cache<'s> {
        Cache { start, ..self }
    }

    /// Returns the stamps for the next run.
    pub(super) fn into_stamps(self) -> FileStamps {
        let mut stamps = self.stamps.into_inner().unwrap_or_else(PoisonError::into_inner);
        stamps.sort();
        stamps
    }
}

impl EarlierRun for Cache<'_> {
    fn for_thread(&self) -> Box<dyn EarlierFiles + '_> {
        Box::new(CachedFiles { cache: self, scratch: Scratch::default(), file: None, stamps: FileStamps::default() })
    }
}

impl CachedFiles<'_> {
    /// Records that the clip of a file is in the old bank.
    fn found(&mut self, index: u32, name: CacheFileName, stamp: Stamp) -> RecalledClip {
        self.stamps.files.push((index, name, stamp));
        self.stamps.recalled.push(index);
        RecalledClip { is_marked: stamp.is_marked() }
    }
}

impl EarlierFiles for CachedFiles<'_> {
    fn look_at(&mut self, index: usize, input: &Input, reader: &mut FileReader) -> Option<RecalledClip> {
        self.file = None;
        let Content::File(path) = &input.content else { return None };
        let meta = Scratch::meta(path, reader)?;
        let name = self.scratch.name(path, &input.key);
        let known = self.cache.before.as_ref();
        let known = known.and_then(|stamps| stamps.get(name, self.scratch.next_stamp(index)));
        let index = index as u32;
        if let Some(stamp) = known.filter(|known| known.proves(&meta)) {
            self.stamps.unread += 1;
            return Some(self.found(index, name, *stamp));
        }
        self.file = Some(CachedFile { index, name, meta, known, stamp: None });
        None
    }

    fn with_bytes(&mut self, bytes: &[u8]) -> Option<RecalledClip> {
        let file = self.file.as_mut()?;
        let contents = hash(bytes);
        let known = file.known.filter(|known| known.has_contents(contents));
        let mut stamp = Stamp::new(file.meta, contents, self.cache.start);
        stamp.mark(known.is_some_and(|known| known.is_marked()));
        let (index, name) = (file.index, file.name);
        file.stamp = Some(stamp);
        known?;
        Some(self.found(index, name, stamp))
    }

    fn remember(&mut self, is_marked: bool) {
        let Some(CachedFile { index, name, stamp: Some(mut stamp), .. }) = self.file.take() else { return };
        stamp.mark(is_marked);
        self.stamps.files.push((index, name, stamp));
    }

    fn finish(self: Box<Self>) {
        self.cache.stamps.lock().unwrap_or_else(PoisonError::into_inner).append(self.stamps);
    }
}

#[cfg(test)]
mod tests {
    use super::Cache;
    use super::FileStamps;
    use crate::project::Options;
    use crate::run::cache::old_bank::OldBank;
    use crate::run::cache::recall::checksum_of;
    use crate::run::cache::stamps::Stamps;
    use crate::run::compile::CompileRun;
    use crate::run::{Compiled, Compiler};
    use std::time::{Duration, SystemTime};

    #[test]
    fn settled_files_are_not_read() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        let (bank, options) = (path("bank"), Options::default());
        std::fs::write(path("a.lipz"), r#"{"visemes":"A-","viseme_type":"blair"}"#).unwrap();
        let inputs = crate::sources::discover(&[path("a.lipz")], None).unwrap();
        Compiler::new(options.clone()).pack(&inputs, &bank).into_bank().unwrap();
        let packed = std::fs::read(&bank).unwrap();
        let run = |before: Option<(&Stamps, &OldBank)>, later: Duration| {
            let (stamps, bank) = before.unzip();
            let cache = Cache::new(stamps, bank).started_at(SystemTime::now() + later);
            CompileRun::read(&inputs, &options, Some(&cache), &|_| {});
            cache.into_stamps()
        };
        let counts = |before: Option<(&Stamps, &OldBank)>, later| {
            let stamped: FileStamps = run(before, later);
            (stamped.files.len(), stamped.recalled.len(), stamped.unread)
        };
        let checksum = checksum_of(&packed).unwrap();
        let old = OldBank::open(&bank, checksum).unwrap();
        assert!(OldBank::open(&bank, 0).is_none(), "the stamps are about another bank");
        for (later, unread) in [(Duration::ZERO, 0), (Duration::from_secs(60), 1)] {
            let stamps = Stamps::new(&options, checksum, run(None, later).files);
            assert_eq!(counts(None, later), (1, 0, 0));
            assert_eq!(counts(Some((&stamps, &old)), later), (1, 1, unread));
        }
    }

    #[test]
    fn stamps_are_in_the_order_of_the_inputs_whatever_threads_did() {
        let folder = tempfile::tempdir().unwrap();
        for number in 0..400 {
            std::fs::write(folder.path().join(format!("{number:03}.lipz")), "{\"text_en-us\":\"Aye.\"}").unwrap();
        }
        let inputs = crate::sources::discover(&[folder.path().into()], None).unwrap();
        let options = Options::new().threads(3);
        let compiler = Compiler::new(options.clone());
        let stamped = || {
            compiler.compile_in_pool(|options| {
                let cache = Cache::of(None);
                CompileRun::read(&inputs, options, Some(&cache), &|_| {});
                let indices: Vec<u32> = cache.into_stamps().files.iter().map(|(index, ..)| *index).collect();
                assert!(indices.into_iter().eq(0..400));
                Compiled::<Vec<u8>>::default()
            })
        };
        (0..20).for_each(|_| drop(stamped()));
    }
}
