//! Linking: the objects of all shards become the bank that packs their sources in one go, byte for byte.

use super::linked_object::{Found, LinkedObject};
use super::misfits::misfits;
use super::object::options_hash;
use crate::clip::Clips;
use crate::compile::{Check, Run, in_file, verify};
use crate::discover::display;
use crate::lower::Layout;
use crate::lower::stream::stream;
use crate::{Compiled, Compiler, Input, Options, OutputFile, Replace, parallel};
use lipz_diagnostics::{Code, Report};
use std::io::Cursor;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

/// The objects of all shards of a plan, ready to be linked: each shard once, made in one way.
#[derive(Clone, Debug)]
pub struct Link {
    pub(super) objects: Vec<LinkedObject>,
}

/// Objects that are kept open while they are linked: systems allow some hundreds of files. More are opened again for each
/// piece.
const MOST_OPEN: usize = 128;

impl Link {
    /// Opens the objects at `paths`, in any order.
    ///
    /// # Errors
    /// Files that are no objects, shards that are missing or there twice, objects that were made in different ways.
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

    /// Path and contents of the settings file with which all objects were made.
    pub fn settings(&self) -> Option<(&str, &str)> {
        let (path, text) = self.objects.first()?.export.settings.as_ref()?;
        Some((path, text))
    }

    /// The objects in the order of their shards.
    pub fn paths(&self) -> impl ExactSizeIterator<Item = &Path> {
        self.objects.iter().map(|object| object.path.as_path())
    }

    /// Number of clips.
    pub fn clip_count(&self) -> usize {
        self.objects.iter().map(|object| object.export.names.len()).sum()
    }

    /// Reports that the objects were made with other options.
    pub(super) fn with_options(&self, options: &Options) -> Result<(), Report> {
        let Some(first) = self.objects.first() else { return Ok(()) };
        if first.export.options == options_hash(options) {
            return Ok(());
        }
        let message = "the objects were made with other options than those that they are linked with";
        Err(Report::failure(display(&first.path), Code::ObjectMisfit, message, "link them as they were packed"))
    }

    /// The clips of all objects, read on all threads, in the order of the shards, and what is known of their recordings.
    fn read(&self, options: &Options, progress: &(dyn Fn(u64) + Sync)) -> Result<Found<Vec<Clips>>, Vec<Report>> {
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

    /// What was reported when the objects were made.
    fn reports(&self) -> Result<Vec<Report>, Report> {
        let mut reports = Vec::new();
        for object in &self.objects {
            reports.extend(object.reports()?);
        }
        Ok(reports)
    }

    /// The inputs of all shards, by their names: their contents are in the objects.
    fn inputs(&self, batches: &[Clips]) -> Vec<Input> {
        let mut inputs = Vec::with_capacity(self.clip_count());
        for (object, clips) in std::iter::zip(&self.objects, batches) {
            inputs.extend(object.inputs(clips));
        }
        // The names of an object are those of its clips in the order of the keys: nearly in order.
        inputs.sort_by(|one, other| one.shown_name().cmp(&other.shown_name()));
        inputs
    }

    /// Whether nobody has written to an object since it was verified.
    fn is_as_it_was(&self, batches: &[Clips]) -> Result<(), Report> {
        let changed = std::iter::zip(&self.objects, batches).find(|(_, clips)| !clips.is_as_it_was());
        changed.map_or(Ok(()), |(object, _)| Err(object.changed()))
    }
}

impl Compiler<'_> {
    /// Links the objects of all shards, and replaces the file at `path` by the bank that [`pack`](Compiler::pack) makes of
    /// their sources in one go: the same bytes, and the same diagnostics but for those about dubs, whose sources are not
    /// read again to show the place.
    ///
    /// Objects are read twice, and what clips own goes from them to the bank piece by piece: in memory are only tables of
    /// all clips, and for each thread one object.
    pub fn link(&self, link: &Link, path: &Path) -> Compiled<OutputFile> {
        let linked = self.link_with(link, |layout, clips, check| {
            self.write_streamed((path, Replace::Always), layout, clips, |clips| link.is_as_it_was(clips), check)
        });
        linked.map(|written| written.file)
    }

    /// The same without a file.
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
        let linked = self.run_any(|options| {
            link.with_options(options).map_err(|report| vec![report])?;
            let (clips, recordings) = link.read(options, &self.progress)?;
            let reports = link.reports().map_err(|report| vec![report])?;
            let options = Options { recordings, ..options.clone() };
            let run = {
                let inputs = link.inputs(&clips);
                Run::of_clips(clips, reports, &inputs, &options).compare_dubs(&inputs, &options)
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
