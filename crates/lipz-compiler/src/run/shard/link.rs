//! Linking the objects of all shards to the bank that packing their sources together would make, byte for byte.

use super::linked_object::{LinkedObject, RecordedClips};
use super::misfits::misfits;
use super::object::options_hash;
use crate::bank::lower::Layout;
use crate::bank::lower::stream::stream;
use crate::bank::verify::verify;
use crate::clip::Clips;
use crate::files::path::display;
use crate::files::{OutputFile, Replace};
use crate::project::Options;
use crate::run::compile::{Check, CompileRun, in_file};
use crate::run::{Compiled, Compiler};
use crate::sources::Input;
use crate::util::parallel;
use lipz_diagnostics::{Code, Report};
use std::io::Cursor;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

/// The objects of all shards of a plan, ready to link: one per shard, made with the same settings.
#[derive(Clone, Debug)]
pub struct Link {
    pub(super) objects: Vec<LinkedObject>,
}

/// The most objects kept open during linking, because systems allow only some hundreds of open files. Others are opened
/// again for each piece.
const MOST_OPEN: usize = 128;

impl Link {
    /// Opens the objects at `paths`, in any order.
    ///
    /// # Errors
    /// If files are not objects, if shards are missing or duplicate, or if objects were made with different settings.
    pub fn open(paths: &[PathBuf]) -> Result<Link, Vec<Report>> {
        let (mut objects, mut faults) = (Vec::new(), Vec::new());
        for path in paths {
            match LinkedObject::open(path) {
                Ok(object) => objects.push(object),
                Err(report) => faults.push(report),
            }
        }
        if faults.is_empty() {
            objects.sort_by(|one, other| (one.export.shard, &one.path).cmp(&(other.export.shard, &other.path)));
            faults.extend(misfits(&objects));
        }
        if faults.is_empty() { Ok(Link { objects }) } else { Err(faults) }
    }

    /// Returns path and contents of the settings file that all objects were made with.
    pub fn settings(&self) -> Option<(&str, &str)> {
        let (path, text) = self.objects.first()?.export.settings.as_ref()?;
        Some((path, text))
    }

    /// Returns the paths of the objects, sorted by shard.
    pub fn paths(&self) -> impl ExactSizeIterator<Item = &Path> {
        self.objects.iter().map(|object| object.path.as_path())
    }

    /// Returns the number of clips.
    pub fn clip_count(&self) -> usize {
        self.objects.iter().map(|object| object.export.names.len()).sum()
    }

    /// Reports an error if the objects were made with different options.
    pub(super) fn with_options(&self, options: &Options) -> Result<(), Report> {
        let Some(first) = self.objects.first() else { return Ok(()) };
        if first.export.options == options_hash(options) {
            return Ok(());
        }
        let message = "the options of the link differ from those of the objects";
        Err(Report::failure(
            display(&first.path),
            Code::ObjectMisfit,
            message,
            "link with the options that the objects were packed with",
        ))
    }

    /// Reads the clips of all objects on all threads, sorted by shard, with the data about their recordings.
    fn read(
        &self,
        options: &Options,
        progress: &(dyn Fn(u64) + Sync),
    ) -> Result<RecordedClips<Vec<Clips>>, Vec<Report>> {
        let next = AtomicUsize::new(0);
        let keep_open = self.objects.len() <= MOST_OPEN;
        let workers = parallel::workers(options.threads, || {
            let (mut found, mut faults, mut room) = (Vec::new(), Vec::new(), Vec::new());
            while let Some(object) = self.objects.get(next.fetch_add(1, Ordering::Relaxed)) {
                match object.read(&options.voices, keep_open, &mut room) {
                    Ok(of_object) => found.push((object.export.shard, of_object)),
                    Err(report) => faults.push(report),
                }
                progress(object.export.names.len() as u64);
            }
            (found, faults)
        });
        let (found, faults): (Vec<_>, Vec<_>) = workers.into_iter().unzip();
        let mut faults: Vec<Report> = faults.into_iter().flatten().collect();
        if !faults.is_empty() {
            lipz_diagnostics::reports::sort(&mut faults);
            return Err(faults);
        }
        let mut found: Vec<_> = found.into_iter().flatten().collect();
        found.sort_by_key(|(shard, _)| *shard);
        let (clips, recordings): (Vec<Clips>, Vec<_>) = found.into_iter().map(|(_, found)| found).unzip();
        Ok((clips, recordings.into_iter().flatten().collect()))
    }

    /// Returns the reports from making the objects.
    fn reports(&self) -> Result<Vec<Report>, Report> {
        let mut reports = Vec::new();
        for object in &self.objects {
            reports.extend(object.reports()?);
        }
        Ok(reports)
    }

    /// Returns the inputs of all shards, as names only, because their contents are in the objects.
    fn inputs(&self, batches: &[Clips]) -> Vec<Input> {
        let mut inputs = Vec::with_capacity(self.clip_count());
        for (object, clips) in std::iter::zip(&self.objects, batches) {
            inputs.extend(object.inputs(clips));
        }
        // The names in an object are sorted by the key of their clips, and therefore nearly sorted.
        inputs.sort_by(|one, other| one.shown_name().cmp(&other.shown_name()));
        inputs
    }

    /// Checks that no object has been modified since it was verified.
    fn is_as_it_was(&self, batches: &[Clips]) -> Result<(), Report> {
        let changed = std::iter::zip(&self.objects, batches).find(|(_, clips)| !clips.is_as_it_was());
        changed.map_or(Ok(()), |(object, _)| Err(object.changed()))
    }
}

impl Compiler<'_> {
    /// Links the objects of all shards, and replaces the file at `path` with the bank that [`pack`](Compiler::pack)
    /// would make from their sources together. Bytes and diagnostics are the same, except that diagnostics about dubs
    /// lack positions, because their sources are not read again.
    ///
    /// Objects are read twice, and the data of clips is copied to the bank piece by piece. Memory holds only tables of
    /// all clips, and one object per thread.
    pub fn link(&self, link: &Link, path: &Path) -> Compiled<OutputFile> {
        let linked = self.link_with(link, |layout, clips, check| {
            self.write_bank_of_layout((path, Replace::Always), layout, clips, |clips| link.is_as_it_was(clips), check)
        });
        linked.map(|written| written.file)
    }

    /// Links the objects to a bank in memory.
    pub fn link_to_bank(&self, link: &Link) -> Compiled {
        self.link_with(link, |layout, clips, check| {
            let mut bank = Cursor::new(Vec::new());
            stream(layout, &clips, &mut bank, false).map_err(|fault| fault.into_report(Path::new("")))?;
            link.is_as_it_was(&clips)?;
            drop(clips);
            check()?;
            verify(bank.get_ref()).map(|()| bank.into_inner())
        })
    }

    fn link_with<T: Send>(
        &self,
        link: &Link,
        write: impl FnOnce(&Layout, Vec<Clips>, &mut Check<'_>) -> Result<T, Report> + Send,
    ) -> Compiled<T> {
        let linked = self.run_in_pool(|options| {
            link.with_options(options).map_err(|report| vec![report])?;
            let (clips, recordings) = link.read(options, &self.progress)?;
            let reports = link.reports().map_err(|report| vec![report])?;
            let options = Options { recordings, ..options.clone() };
            let run = {
                let inputs = link.inputs(&clips);
                CompileRun::of_clips(clips, reports, &inputs, &options).compare_dubs(&inputs, &options)
            };
            let name = |report, batches: &[Clips]| in_file(report, &link.inputs(batches));
            Ok(run.write(&options, name, write))
        });
        match linked {
            Ok(Ok(linked)) => linked,
            Ok(Err(reports)) => Compiled { reports, ..Compiled::default() },
            Err(report) => Compiled::refused(report),
        }
    }
}
