//! Linking: the objects of all shards become the bank that packs their sources in one go, byte for byte.

use super::linked_object::{Found, LinkedObject};
use super::misfits::misfits;
use super::object::options_hash;
use crate::compile::{Run, verify};
use crate::discover::display;
use crate::{Compiled, Compiler, Input, Options, parallel};
use lipz_diagnostics::{Code, Report};
use std::collections::BTreeMap;
use std::mem;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

/// The objects of all shards of a plan, ready to be linked: each shard once, made in one way.
#[derive(Clone, Debug)]
pub struct Link {
    pub(super) objects: Vec<LinkedObject>,
}

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

    /// The clips of all objects, read on all threads, and what is known of their recordings.
    fn read(
        &self,
        options: &Options,
        progress: &(dyn Fn(u64) + Sync),
    ) -> Result<(Vec<Found>, Vec<Report>), Vec<Report>> {
        let next = AtomicUsize::new(0);
        let workers = parallel::workers(options.threads, || {
            let (mut found, mut faults) = (Vec::new(), Vec::new());
            while let Some(object) = self.objects.get(next.fetch_add(1, Ordering::Relaxed)) {
                match object.read(&options.voices) {
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
        let mut found: Vec<(u16, Found)> = found.into_iter().flatten().collect();
        found.sort_by_key(|(shard, _)| *shard);
        let mut reports = Vec::new();
        for object in &self.objects {
            reports.extend(object.reports().map_err(|report| vec![report])?);
        }
        Ok((found.into_iter().map(|(_, found)| found).collect(), reports))
    }

    /// The inputs of all shards, by their names: their contents are in the objects.
    fn inputs(&self, found: &[Found]) -> Vec<Input> {
        let mut inputs = Vec::with_capacity(self.clip_count());
        for (object, found) in std::iter::zip(&self.objects, found) {
            inputs.extend(object.inputs(found));
        }
        inputs.sort_by_cached_key(Input::name);
        inputs
    }
}

impl Compiler<'_> {
    /// Links the objects of all shards, and replaces the file at `path` by the bank that [`pack`](Compiler::pack) makes of
    /// their sources in one go: the same bytes, and the same diagnostics but for those about dubs, whose sources are not
    /// read again to show the place.
    pub fn link(&self, link: &Link, path: &Path) -> Compiled {
        self.link_with(link, |bank| self.write_verified(path, bank))
    }

    /// The same without a file.
    pub fn link_to_bank(&self, link: &Link) -> Compiled {
        self.link_with(link, verify)
    }

    fn link_with(&self, link: &Link, finish: impl FnOnce(&[u8]) -> Result<(), Report> + Send) -> Compiled {
        self.run(|options| {
            if let Err(report) = link.with_options(options) {
                return Compiled::refused(report);
            }
            let (mut found, reports) = match link.read(options, &self.progress) {
                Ok(read) => read,
                Err(reports) => return Compiled { reports, ..Compiled::default() },
            };
            let inputs = link.inputs(&found);
            let mut recordings = BTreeMap::new();
            found.iter_mut().for_each(|found| recordings.append(&mut found.recordings));
            let clips = found.iter_mut().map(|found| mem::take(&mut found.clips)).collect();
            let options = Options { recordings, ..options.clone() };
            let run = Run::of_clips(clips, reports, &inputs, &options).compare_dubs(&inputs, &options);
            run.make(&inputs, &options, finish)
        })
    }
}
