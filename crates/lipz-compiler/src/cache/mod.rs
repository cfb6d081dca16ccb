//! Packing again after few files changed: what did not change is recalled from the old bank.
//!
//! The bank holds the contents of all clips already. The file of the cache holds what proves that they
//! are those of the files: how each file looked, the hash of its contents, and the checksum of the
//! bank. Nothing is believed without proof, so that the new bank is the one that a run without a cache
//! makes. `docs/ARCHITECTURE.md` says what is trusted when.

#[cfg(feature = "shards")]
mod all;
mod file;
mod file_meta;
mod look;
mod memory;
mod old_bank;
mod patch;
mod recall;
mod stamps;
mod sweep;

#[cfg(feature = "shards")]
pub(crate) use all::clips_of;
pub(crate) use look::Look;
pub use memory::Memory;
pub(crate) use stamps::{Name, Stamp};

use crate::compile::{Progress, Run, Texts};
use crate::discover::display;
use crate::{Compiled, Compiler, Content, Input, Options};
use file_meta::FileMeta;
use lipz_diagnostics::Report;
use old_bank::OldBank;
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
        let finish = |bank: &[u8], origin: Origin| {
            accept(bank)?;
            match origin {
                Origin::Unchanged if touch(path).is_ok() => Ok(()),
                Origin::Patched => self.write_if(path, bank, || Ok(())),
                _ => self.write_verified(path, bank),
            }
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

/// Where a bank comes from.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Origin {
    /// It is the old one.
    Unchanged,
    /// Of the old one, with some clips in it that are new: see [`patch`].
    Patched,
    /// It was made of all clips, and is not verified yet.
    New,
}

/// Makes a bank of `inputs` with what is still true of the run `before`. `finish` is handed the bank, and where
/// it comes from; without its consent there is none.
///
/// With a bank come the stamps of its files, unless they are all as they were.
fn again(
    inputs: &[Input],
    options: &Options,
    before: Option<PreviousRun>,
    progress: &Progress<'_>,
    finish: impl FnOnce(&[u8], Origin) -> Result<(), Report> + Send,
) -> (Compiled, Option<Stamps>) {
    let start = Instant::now();
    let before = before.filter(|before| before.stamps.are_of(options));
    let (stamps, old) = before.map(|before| (before.stamps, before.bank)).unzip();
    let cache = Cache::new(stamps.as_deref(), old.as_ref());
    let recalling = start.elapsed();
    let mut run = Run::read(inputs, options, Some(&cache), progress);
    run.phases.cache = recalling;
    let found = run.stamped.recalled.len();
    let cache_clip_count = cache.clip_count();
    let is_unchanged = found == inputs.len() && cache_clip_count == Some(found);
    let are_stamps_unchanged = is_unchanged && run.stamped.unread == found && cache.stamp_count() == found;
    drop(cache);
    drop(stamps);
    if is_unchanged && !run.has_errors() {
        // Nothing is copied, least of all to be thrown away.
        if let Some(bank) = old.and_then(OldBank::into_whole) {
            let files = std::mem::take(&mut run.stamped.files);
            let compiled = match run
                .expect(&Texts::of_old(&bank, options), options)
                .and_then(|()| finish(&bank, Origin::Unchanged))
            {
                Ok(()) => Compiled { is_unchanged, ..run.finish(Some(bank)) },
                Err(report) => run.fail(report),
            };
            let stamps = (!are_stamps_unchanged).then(|| Stamps::of(&compiled, options, files));
            return (compiled, stamps.flatten());
        }
        run = Run::read(inputs, options, Some(&Cache::new(None, None)), &|_| ());
    } else if !run.has_errors() {
        let start = Instant::now();
        // Before it is recalled from, and only then: a bank that stays is read once.
        let recall = old.as_ref().filter(|old| found > 0 && old.is_proven()).and_then(Recall::new);
        let has_same_keys = cache_clip_count == Some(inputs.len()) && found + run.clip_count() == inputs.len();
        // What is said about dubs is about all clips, not about those that have changed.
        let recall_few = recall.as_ref().filter(|_| has_same_keys && options.voices.patterns.is_empty());
        if let Some(bank) = recall_few.and_then(|recall| patch::patched(recall, &run.changed_clips())) {
            run.phases.lower = start.elapsed();
            let files = std::mem::take(&mut run.stamped.files);
            let compiled = run.conclude(Ok(bank), options, |bank| finish(bank, Origin::Patched));
            let stamps = Stamps::of(&compiled, options, files);
            return (compiled, stamps);
        }
        let clips = match &recall {
            Some(recall) => sweep::recalled(recall, inputs, &run.stamped.recalled, options.threads),
            None => (found == 0).then(Vec::new),
        };
        match clips {
            Some(clips) => run.add(clips, start.elapsed()),
            // The old bank is damaged, or somebody has written to it meanwhile.
            None => run = Run::read(inputs, options, Some(&Cache::new(None, None)), &|_| ()),
        }
        // The old bank is given back before the new one is made.
        drop(old);
    }
    run = run.compare_dubs(inputs, options);
    let files = std::mem::take(&mut run.stamped.files);
    let compiled = run.make(inputs, options, |bank| finish(bank, Origin::New));
    let stamps = Stamps::of(&compiled, options, files);
    (compiled, stamps)
}

/// Gives the file at `path` the current time, for build tools that compare it with those of the sources.
fn touch(path: &Path) -> io::Result<()> {
    File::options().append(true).open(path)?.set_modified(SystemTime::now())
}

/// What the run before this one left: stamps, and the bank that they are about. A clone shares both.
#[derive(Clone)]
struct PreviousRun {
    stamps: Arc<Stamps>,
    bank: OldBank,
}

impl PreviousRun {
    /// What the file `cache` and the bank at `path` tell; `None` if they tell nothing, for whatever reason.
    ///
    /// # Errors
    /// If there is something else than a cache at `cache`.
    fn read(cache: &Path, path: &Path) -> Result<Option<PreviousRun>, Report> {
        let Some(stamps) = file::read(cache)? else { return Ok(None) };
        let bank = OldBank::open(path, stamps.bank_checksum);
        Ok(bank.map(|bank| PreviousRun { stamps: stamps.into(), bank }))
    }
}

/// What a run asks for the clips of files that did not change.
pub(crate) struct Cache<'s> {
    /// The stamps of the run before, and how many clips its bank has.
    before: Option<(Lookup<'s>, usize)>,
    start: SystemTime,
}

/// What a run has stamped and found in the old bank.
#[derive(Default)]
pub(crate) struct FileStamps {
    /// The stamps of all files without diagnostics, with the numbers of their inputs.
    pub(crate) files: Vec<(u32, Name, Stamp)>,
    /// Numbers of inputs whose clips are in the old bank.
    pub(crate) recalled: Vec<u32>,
    /// Of these, those whose files were not read.
    pub(crate) unread: usize,
}

impl FileStamps {
    /// Adds what another thread has.
    pub(crate) fn append(&mut self, mut other: FileStamps) {
        self.files.append(&mut other.files);
        self.recalled.append(&mut other.recalled);
        self.unread += other.unread;
    }

    /// Puts the stamps into the order of the inputs, in which the next run looks for them.
    pub(crate) fn sort(&mut self) {
        self.files.sort_unstable_by_key(|(index, ..)| *index);
    }
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
    fn new(stamps: Option<&'s Stamps>, bank: Option<&OldBank>) -> Cache<'s> {
        let clip_count = bank.and_then(OldBank::clip_count);
        Cache { before: stamps.map(Stamps::lookup).zip(clip_count), start: SystemTime::now() }
    }

    fn clip_count(&self) -> Option<usize> {
        self.before.as_ref().map(|(_, clip_count)| *clip_count)
    }

    fn stamp_count(&self) -> usize {
        self.before.as_ref().map_or(0, |(stamps, _)| stamps.count())
    }

    /// Looks at the file of input number `index`; `None` if it has none, or cannot be looked at.
    pub(crate) fn file<'c>(&'c self, index: usize, input: &'c Input, look: &mut Look) -> Option<CachedFile<'c>> {
        let Content::File(path) = &input.content else { return None };
        let meta = look.meta(path)?;
        let name = look.name(path, &input.key);
        let known = self.before.as_ref().and_then(|(stamps, _)| stamps.get(name, look.next_stamp(index)));
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
        let is_known = self.known.is_some_and(|known| known.has_contents(contents));
        (Stamp::new(self.meta, contents, self.cache.start), is_known)
    }

    /// The name of the file in a cache.
    pub(crate) fn name(&self) -> Name {
        self.name
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
        let packed = Compiler::new(options.clone()).pack(&inputs, &bank).bank.unwrap();
        let run = |before: Option<(&Stamps, &OldBank)>, later: Duration| {
            let (stamps, bank) = before.unzip();
            let cache = Cache { start: SystemTime::now() + later, ..Cache::new(stamps, bank) };
            Run::read(&inputs, &options, Some(&cache), &|_| {}).stamped
        };
        let counts = |before: Option<(&Stamps, &OldBank)>, later| {
            let stamped = run(before, later);
            (stamped.files.len(), stamped.recalled.len(), stamped.unread)
        };
        let checksum = recall::checksum_of(&packed).unwrap();
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
        let (inputs, _) = crate::discover(&[folder.path().into()], None);
        let options = Options::new().threads(3);
        let compiler = Compiler::new(options.clone());
        let stamped = || {
            compiler.run(|options| {
                let run = Run::read(&inputs, options, Some(&Cache::new(None, None)), &|_| {});
                let indices: Vec<u32> = run.stamped.files.iter().map(|(index, ..)| *index).collect();
                assert!(indices.into_iter().eq(0..400));
                Compiled::default()
            })
        };
        (0..20).for_each(|_| drop(stamped()));
    }
}
