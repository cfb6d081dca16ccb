//! Packing again after few files changed: what did not change is recalled from the old bank.
//!
//! The bank holds the contents of all clips already. The file of the cache holds what proves that they
//! are those of the files: how each file looked, the hash of its contents, and the checksum of the
//! bank. Nothing is believed without proof, so that the new bank is the one that a run without a cache
//! makes. `docs/ARCHITECTURE.md` says what is trusted when.

mod cached_file;
mod check;
mod few;
mod file;
mod file_meta;
mod in_file;
mod in_memory;
mod look;
mod memory;
mod old_bank;
mod patch;
mod recall;
mod stamps;
mod sweep;

pub(crate) use cached_file::{Cache, CachedFile};
#[cfg(feature = "shards")]
pub(crate) use file_meta::FileMeta;
pub(crate) use look::Look;
pub use memory::Memory;
#[cfg(feature = "shards")]
pub(crate) use old_bank::section;
#[cfg(feature = "shards")]
pub(crate) use recall::{are_in_order, recall_tables};
pub(crate) use stamps::{Name, Stamp};

use crate::compile::{Progress, Run, Texts};
use crate::discover::display;
use crate::{Compiled, Compiler, Input, Options, OutputFile, Replace};
use few::Known;
use in_file::Place;
use lipz_diagnostics::Report;
use old_bank::OldBank;
use recall::{Recall, checksum_of};
use stamps::{MAGIC, Stamps};
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
    pub fn pack_cached(&self, inputs: &[Input], path: &Path, cache: &Path) -> Compiled<OutputFile> {
        let place = Place { path, replace: Replace::Always };
        let mut packed =
            self.cached(inputs, path, cache, |task, next| in_file::end(self, task, next, &place, &mut Vec::new()));
        packed.is_unchanged &= packed.bank.as_ref().is_some_and(|file| !file.is_new);
        packed
    }

    /// The same with a bank that is made in memory, if `accept` finds nothing in it: without its consent nothing is written.
    #[cfg(feature = "build")]
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
        self.cached(inputs, path, cache, |task, next| in_memory::end(task, next, finish))
    }

    /// Packs with what is in the file `cache`, and writes that anew.
    fn cached<B: Send>(
        &self,
        inputs: &[Input],
        path: &Path,
        cache: &Path,
        end: impl FnOnce(&Task<'_>, Next) -> Done<B> + Send,
    ) -> Compiled<B> {
        self.run(|options| {
            let start = Instant::now();
            let before = match PreviousRun::read(cache, path) {
                Ok(before) => before,
                Err(report) => return Compiled::refused(report),
            };
            let reading = start.elapsed();
            let task = Task { inputs, options, progress: &self.progress, changed: None };
            let Done { compiled, stamps, .. } = end(&task, next(&task, before, &mut Vec::new()));
            let start = Instant::now();
            let written = stamps.and_then(|stamps| self.guarded(|| file::write(cache, MAGIC, &stamps)));
            let mut compiled = compiled.and_then(|bank| match written {
                Some(Err(mut report)) => {
                    let note = format!("the bank is written: `{}` is that of these files", display(path));
                    report.diagnostics.iter_mut().for_each(|diagnostic| diagnostic.notes.push(note.clone()));
                    Err(report)
                }
                _ => Ok(bank),
            });
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

/// What a run is to make a bank of.
struct Task<'t> {
    inputs: &'t [Input],
    options: &'t Options,
    progress: &'t Progress<'t>,
    /// Numbers of the inputs whose files can have changed since the run before, if that is known: no other file is looked
    /// at.
    changed: Option<&'t [usize]>,
}

/// How a run goes on that has looked at all files.
enum Next {
    /// Nothing is made: there are errors.
    Nothing(Run),
    /// The old bank stays if it is proven; and whether its stamps do, too.
    Stay(Run, OldBank, bool),
    /// The bank is the old one with some clips in it that are new.
    Patch(Run, Vec<u8>),
    /// The bank is to be made of all clips.
    Make(Run),
}

/// What a run has made.
struct Done<B = Vec<u8>> {
    compiled: Compiled<B>,
    /// With a bank come the stamps of its files, unless they are all as they were.
    stamps: Option<Stamps>,
    /// What a run has to know that looks only at what changed since.
    known: Option<Known>,
}

/// Looks at the inputs, with what is still true of the run `before`. A patched bank is made in `room`, which is given back where
/// the clips need the memory.
fn next(task: &Task<'_>, before: Option<PreviousRun>, room: &mut Vec<u8>) -> Next {
    let options = task.options;
    let before = before.filter(|before| before.stamps.are_of(options));
    let mut looked = Looked::at(task, before.as_ref());
    let old = before.map(|before| before.bank);
    if looked.run.has_errors() {
        return Next::Nothing(looked.compare_dubs(task));
    }
    if looked.is_unchanged {
        return match old {
            Some(old) => Next::Stay(looked.run, old, looked.are_stamps_unchanged),
            None => Next::Make(read_all(task)),
        };
    }
    let start = Instant::now();
    let recall = old.as_ref().filter(|_| looked.found > 0).and_then(Recall::new);
    // What is said about dubs is about all clips, not about those that have changed.
    let recall_few = recall.as_ref().filter(|_| looked.has_same_keys && options.voices.patterns.is_empty());
    let changed = looked.run.changed_clips();
    let room = std::mem::take(room);
    if let Some(bank) = recall_few.and_then(|recall| patch::patched(recall, &changed, room)) {
        drop(changed);
        looked.run.phases.lower = start.elapsed();
        return Next::Patch(looked.run, bank);
    }
    drop(changed);
    // Before all else is recalled from it, and only then: a bank that stays or is patched is read once.
    let clips = match recall.as_ref().filter(|recall| recall.old.is_proven()) {
        Some(recall) => sweep::recalled(recall, task.inputs, &looked.run.stamped.recalled, options.threads),
        None => (looked.found == 0).then(Vec::new),
    };
    match clips {
        Some(clips) => looked.run.add(clips, start.elapsed()),
        // The old bank is damaged, or somebody has written to it meanwhile.
        None => return Next::Make(read_all(task)),
    }
    Next::Make(looked.compare_dubs(task))
}

/// A run that reads all files, and stamps them.
fn read_all(task: &Task<'_>) -> Run {
    Run::read(task.inputs, task.options, Some(&Cache::new(None, None)), &|_| ()).compare_dubs(task.inputs, task.options)
}

/// A run that has looked at files, and what follows for the old bank.
struct Looked {
    run: Run,
    /// Number of the clips that are in it.
    found: usize,
    /// Whether it is that of all the files.
    is_unchanged: bool,
    /// Whether there is nothing new in the stamps either.
    are_stamps_unchanged: bool,
    /// Whether it has the same keys.
    has_same_keys: bool,
}

impl Looked {
    /// Looks at the files that can have changed since the run `before`.
    fn at(task: &Task<'_>, before: Option<&PreviousRun>) -> Looked {
        let start = Instant::now();
        let Task { inputs, options, progress, changed } = task;
        let clip_count = before.and_then(|before| before.bank.clip_count());
        let few = before.zip(*changed).and_then(|(before, changed)| Some((before, before.few(inputs, changed)?)));
        let run = match few {
            Some((before, few)) => few.read(task, before),
            None => {
                let cache = Cache::new(before.map(|before| &*before.stamps), before.map(|before| &before.bank));
                let recalling = start.elapsed();
                let mut run = Run::read(inputs, options, Some(&cache), progress);
                run.phases.cache = recalling;
                run
            }
        };
        let found = run.stamped.recalled.len();
        let stamp_count = before.map_or(0, |before| before.stamps.count());
        let is_unchanged = found == inputs.len() && clip_count == Some(found);
        Looked {
            found,
            is_unchanged,
            are_stamps_unchanged: is_unchanged && run.stamped.unread == found && stamp_count == found,
            has_same_keys: clip_count == Some(inputs.len()) && found + run.clip_count() == inputs.len(),
            run,
        }
    }

    fn compare_dubs(self, task: &Task<'_>) -> Run {
        self.run.compare_dubs(task.inputs, task.options)
    }
}

impl Run {
    /// Ends the run, and keeps what the next one has to know. A bank comes with its checksum.
    fn done<B>(mut self, task: &Task<'_>, end: impl FnOnce(Run) -> Compiled<(B, u64)>) -> Done<B> {
        let files = std::mem::take(&mut self.stamped.files);
        let known = self.are_keys_fine.then(|| Known::new(&files, task.inputs.len()));
        let compiled = end(self);
        let checksum = compiled.bank.as_ref().map(|(_, checksum)| *checksum);
        let stamps = checksum.map(|checksum| Stamps::new(task.options, checksum, files));
        let known = known.filter(|_| stamps.is_some());
        Done { compiled: compiled.map(|(bank, _)| bank), stamps, known }
    }

    /// The same with the old bank, unless the project no longer accepts it or `end` fails.
    fn stays<B>(
        self,
        task: &Task<'_>,
        (bank, are_stamps_unchanged): (&[u8], bool),
        end: impl FnOnce() -> Result<B, Report>,
    ) -> Done<B> {
        let texts = Texts::of_old(bank, task.options);
        let checksum = checksum_of(bank).unwrap_or_default();
        let mut done = self.done(task, |mut run| match run.expect(&texts, task.options).and_then(|()| end()) {
            Ok(bank) => Compiled { is_unchanged: true, ..run.finish(Some((bank, checksum))) },
            Err(report) => run.fail(report),
        });
        done.stamps = done.stamps.filter(|_| !are_stamps_unchanged);
        done
    }
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
    /// What is known of its inputs, if it was in this process.
    known: Option<Arc<Known>>,
}

impl PreviousRun {
    /// What the file `cache` and the bank at `path` tell; `None` if they tell nothing, for whatever reason.
    ///
    /// # Errors
    /// If there is something else than a cache at `cache`.
    fn read(cache: &Path, path: &Path) -> Result<Option<PreviousRun>, Report> {
        let Some(stamps) = file::read(cache, MAGIC)? else { return Ok(None) };
        let bank = OldBank::open(path, stamps.bank_checksum);
        Ok(bank.map(|bank| PreviousRun { stamps: stamps.into(), bank, known: None }))
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
        let inputs = crate::discover(&[path("a.lipz")], None).unwrap();
        Compiler::new(options.clone()).pack(&inputs, &bank).into_bank().unwrap();
        let packed = std::fs::read(&bank).unwrap();
        let run = |before: Option<(&Stamps, &OldBank)>, later: Duration| {
            let (stamps, bank) = before.unzip();
            let cache = Cache { start: SystemTime::now() + later, ..Cache::new(stamps, bank) };
            Run::read(&inputs, &options, Some(&cache), &|_| {}).stamped
        };
        let counts = |before: Option<(&Stamps, &OldBank)>, later| {
            let stamped = run(before, later);
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
        let inputs = crate::discover(&[folder.path().into()], None).unwrap();
        let options = Options::new().threads(3);
        let compiler = Compiler::new(options.clone());
        let stamped = || {
            compiler.run(|options| {
                let run = Run::read(&inputs, options, Some(&Cache::new(None, None)), &|_| {});
                let indices: Vec<u32> = run.stamped.files.iter().map(|(index, ..)| *index).collect();
                assert!(indices.into_iter().eq(0..400));
                Compiled::<Vec<u8>>::default()
            })
        };
        (0..20).for_each(|_| drop(stamped()));
    }
}
