//! Packing again after few files changed: what did not change is recalled from the old bank.
//!
//! The bank holds the contents of all clips already. The file of the cache holds what proves that they
//! are those of the files: how each file looked, the hash of its contents, and the checksum of the
//! bank. Nothing is believed without proof, so that the new bank is the one that a run without a cache
//! makes. `docs/ARCHITECTURE.md` says what is trusted when.

mod file;
mod file_meta;
mod memory;
mod recall;
mod stamps;

pub use memory::Memory;
pub(crate) use stamps::{Name, Stamp};

use crate::clip::{ClipData, Locales};
use crate::compile::{Progress, Run};
use crate::discover::display;
use crate::{Compiled, Compiler, Content, Input, Options};
use file_meta::FileMeta;
use lipz_diagnostics::Report;
use recall::Recall;
use stamps::{Lookup, Stamps, hash};
use std::fs::File;
use std::io;
use std::path::Path;
use std::sync::Arc;
use std::time::{Instant, SystemTime};

impl Compiler<'_> {
    /// Does what [`pack`](Compiler::pack) does, and remembers the files in the file `cache`, so that the next
    /// run reads only those that changed: the clips of all others are recalled from the bank at `path`. The
    /// bank is the same, byte by byte, as that of [`pack`](Compiler::pack).
    ///
    /// Files with diagnostics are read in every run, so that the diagnostics are reported again. If no clip
    /// changed, the bank stays and gets the current time as that of its modification.
    ///
    /// The cache is safe to delete. One that is damaged, that another version of this library wrote, or that
    /// belongs to another bank or to other options is ignored and replaced. A file that is no cache is left
    /// alone and reported, as is one that cannot be written.
    pub fn pack_cached(&self, inputs: &[Input], path: &Path, cache: &Path) -> Compiled {
        self.pack_cached_if(inputs, path, cache, |_| Ok(()))
    }

    /// The same, if `accept` finds nothing in the bank: without its consent nothing is written.
    pub(crate) fn pack_cached_if(
        &self,
        inputs: &[Input],
        path: &Path,
        cache: &Path,
        accept: impl FnOnce(&[u8]) -> Result<(), Report> + Send,
    ) -> Compiled {
        let finish = |bank: &[u8], is_unchanged: bool| {
            accept(bank)?;
            if is_unchanged && touch(path).is_ok() { Ok(()) } else { self.write_verified(path, bank) }
        };
        self.run(|options| {
            let start = Instant::now();
            let before = match PreviousRun::read(cache, path) {
                Ok(before) => before,
                Err(report) => return Compiled::refused(report),
            };
            let reading = start.elapsed();
            let (mut compiled, stamps) = again(inputs, options, before, &self.progress, finish);
            let start = Instant::now();
            let written = stamps.and_then(|stamps| self.guarded(|| file::write(cache, &stamps)));
            if let Some(Err(mut report)) = written {
                let note = format!("the bank is written: `{}` is that of these files", display(path));
                report.diagnostics.iter_mut().for_each(|diagnostic| diagnostic.notes.push(note.clone()));
                compiled.reports.push(report);
                compiled.bank = None;
            }
            compiled.phases.cache += reading + start.elapsed();
            compiled
        })
    }
}

/// Makes a bank of `inputs` with what is still true of the run `before`. `finish` is handed the bank, and whether
/// it is the old one; without its consent there is none.
///
/// With a bank come the stamps of its files, unless they are all as they were.
fn again(
    inputs: &[Input],
    options: &Options,
    before: Option<PreviousRun>,
    progress: &Progress<'_>,
    finish: impl FnOnce(&[u8], bool) -> Result<(), Report> + Send,
) -> (Compiled, Option<Stamps>) {
    let start = Instant::now();
    let before = before.filter(|before| before.stamps.are_of(options));
    let cached = Cache::new(before.as_ref());
    let recalling = start.elapsed();
    let mut run = Run::read(inputs, options, Some(&cached), progress);
    run.phases.cache = recalling;
    let files = std::mem::take(&mut run.stamped.files);
    let is_unchanged = run.stamped.recalled == inputs.len() && cached.clip_count() == Some(inputs.len());
    let are_stamps_unchanged =
        is_unchanged && run.stamped.unread == inputs.len() && cached.stamp_count() == inputs.len();
    drop(cached);
    let old_bank = before.map(|before| before.bank);
    let compiled = match old_bank {
        Some(bank) if is_unchanged && !run.has_errors() => {
            match run.expect_locales(&bank, options).and_then(|()| finish(&bank, true)) {
                Ok(()) => Compiled { is_unchanged, ..run.finish(Some(Arc::unwrap_or_clone(bank))) },
                Err(report) => run.fail(report),
            }
        }
        // The old bank is given back before the new one is made.
        old_bank => {
            drop(old_bank);
            run.make(inputs, options, |bank| finish(bank, false))
        }
    };
    let checksum = compiled.bank.as_deref().and_then(recall::checksum_of).filter(|_| !are_stamps_unchanged);
    (compiled, checksum.map(|checksum| Stamps::new(options, checksum, files)))
}

/// Gives the file at `path` the current time, for build tools that compare it with those of the sources.
fn touch(path: &Path) -> io::Result<()> {
    File::options().append(true).open(path)?.set_modified(SystemTime::now())
}

/// What the run before this one left: stamps, and the bank that they are about. A clone shares both.
#[derive(Clone)]
struct PreviousRun {
    stamps: Arc<Stamps>,
    bank: Arc<Vec<u8>>,
}

impl PreviousRun {
    /// What the file `cache` and the bank at `path` tell; `None` if they tell nothing, for whatever reason.
    ///
    /// # Errors
    /// If there is something else than a cache at `cache`.
    fn read(cache: &Path, path: &Path) -> Result<Option<PreviousRun>, Report> {
        let Some(stamps) = file::read(cache)? else { return Ok(None) };
        let is_file = path.metadata().is_ok_and(|metadata| metadata.is_file());
        let bank = is_file.then(|| std::fs::read(path).ok()).flatten();
        Ok(bank.map(|bank| PreviousRun { stamps: stamps.into(), bank: bank.into() }))
    }
}

/// What a run asks for the clips of files that did not change.
pub(crate) struct Cache<'b> {
    before: Option<(Lookup<'b>, Recall<'b>)>,
    start: SystemTime,
}

/// What a run has stamped and recalled.
#[derive(Default)]
pub(crate) struct FileStamps {
    /// The stamps of all files without diagnostics.
    pub(crate) files: Vec<(Name, Stamp)>,
    /// Clips that were recalled.
    pub(crate) recalled: usize,
    /// Of these, those whose files were not read.
    pub(crate) unread: usize,
}

impl FileStamps {
    /// Adds what another thread has.
    pub(crate) fn append(&mut self, mut other: FileStamps) {
        self.files.append(&mut other.files);
        self.recalled += other.recalled;
        self.unread += other.unread;
    }
}

/// A file that was looked at.
pub(crate) struct CachedFile<'c> {
    cache: &'c Cache<'c>,
    key: &'c str,
    name: Name,
    meta: FileMeta,
    /// Its stamp of the run before.
    known: Option<&'c Stamp>,
}

impl<'b> Cache<'b> {
    fn new(before: Option<&'b PreviousRun>) -> Cache<'b> {
        let recalling = |before: &'b PreviousRun| {
            let recall = Recall::new(&before.bank, before.stamps.bank_checksum)?;
            Some((before.stamps.lookup(), recall))
        };
        Cache { before: before.and_then(recalling), start: SystemTime::now() }
    }

    fn clip_count(&self) -> Option<usize> {
        self.before.as_ref().map(|(_, recall)| recall.clip_count())
    }

    fn stamp_count(&self) -> usize {
        self.before.as_ref().map_or(0, |(stamps, _)| stamps.count())
    }

    /// Looks at the file of an input; `None` if it has none, or cannot be looked at. Its stamp is probably number
    /// `next`, which is then counted on.
    pub(crate) fn file<'c>(&'c self, input: &'c Input, next: &mut usize) -> Option<CachedFile<'c>> {
        let Content::File(path) = &input.content else { return None };
        let meta = FileMeta::new(&path.metadata().ok()?)?;
        let name = Name::new(path.as_os_str().as_encoded_bytes(), &input.key);
        let known = self.before.as_ref().and_then(|(stamps, _)| stamps.get(name, next));
        Some(CachedFile { cache: self, key: &input.key, name, meta, known })
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
        let is_same = self.known.is_some_and(|known| known.has_contents(contents));
        (Stamp::new(self.meta, contents, self.cache.start), is_same)
    }

    /// The key of the file's clip.
    pub(crate) fn key(&self) -> &str {
        self.key
    }

    /// The name of the file in a cache.
    pub(crate) fn name(&self) -> Name {
        self.name
    }

    /// Makes `clip` the one that the file was packed as; false if the old bank does not have it.
    pub(crate) fn recall(&self, locales: &mut Locales, clip: &mut ClipData) -> bool {
        let recall = self.cache.before.as_ref().map(|(_, recall)| recall);
        recall.and_then(|recall| recall.clip(self.key, locales, clip)).is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    #[test]
    fn settled_files_are_not_read() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        let (bank, options) = (path("bank"), Options::default());
        std::fs::write(path("a.lipz"), r#"{"visemes":"A-","viseme_type":"blair"}"#).unwrap();
        let (inputs, _) = crate::discover(&[path("a.lipz")], None);
        let packed = Arc::new(Compiler::new(options.clone()).pack(&inputs, &bank).bank.unwrap());
        let run = |before: Option<&PreviousRun>, later: Duration| {
            let cache = Cache { start: SystemTime::now() + later, ..Cache::new(before) };
            Run::read(&inputs, &options, Some(&cache), &|_| {}).stamped
        };
        let counts = |before: Option<&PreviousRun>, later| {
            let stamped = run(before, later);
            (stamped.files.len(), stamped.recalled, stamped.unread)
        };
        for (later, unread) in [(Duration::ZERO, 0), (Duration::from_secs(60), 1)] {
            let stamps = Stamps::new(&options, recall::checksum_of(&packed).unwrap(), run(None, later).files);
            let mut before = PreviousRun { stamps: stamps.into(), bank: Arc::clone(&packed) };
            assert_eq!(counts(None, later), (1, 0, 0));
            assert_eq!(counts(Some(&before), later), (1, 1, unread));
            Arc::get_mut(&mut before.stamps).unwrap().bank_checksum = 0;
            assert_eq!(counts(Some(&before), later), (1, 0, 0), "the stamps are about another bank");
        }
    }
}
