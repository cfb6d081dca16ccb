//! Linking: the objects of all shards become the bank that packs their sources in one go, byte for byte.

use super::export::{self, Export};
use super::object::options_hash;
use super::plan::MAKER;
use crate::cache::clips_of;
use crate::clip::Clips;
use crate::compile::{Run, verify};
use crate::discover::display;
use crate::{Compiled, Compiler, Content, Input, Options, parallel};
use lipz_bank::{Bank, Recording};
use lipz_diagnostics::{Code, Diagnostic, Report, escape};
use std::collections::BTreeMap;
use std::mem;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

/// The objects of all shards of a plan, ready to be linked: each shard once, made in one way.
#[derive(Clone, Debug)]
pub struct Link {
    objects: Vec<LinkedObject>,
}

/// An object that was opened.
#[derive(Clone, Debug)]
pub struct LinkedObject {
    pub(super) path: PathBuf,
    pub(super) checksum: u64,
    pub(super) export: Export,
}

/// What the clips of an object come with.
#[derive(Default)]
struct Found {
    clips: Clips,
    recordings: BTreeMap<String, Recording>,
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
    fn with_options(&self, options: &Options) -> Result<(), Report> {
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
                match object.read() {
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
            for wire in object.export.reports.iter().cloned() {
                reports.push(wire.into_report().ok_or_else(|| vec![object.damaged("a diagnostic in it is none")])?);
            }
        }
        Ok((found.into_iter().map(|(_, found)| found).collect(), reports))
    }

    /// The inputs of all shards, by their names: their contents are in the objects.
    fn inputs(&self, found: &[Found]) -> Vec<Input> {
        let mut inputs = Vec::with_capacity(self.clip_count());
        for (object, found) in std::iter::zip(&self.objects, found) {
            // Both are in the order of the keys.
            for (clip, name) in found.clips.iter().zip(&object.export.names) {
                let content = Content::Bytes { name: name.clone(), bytes: Vec::new() };
                inputs.push(Input { key: clip.key().to_owned(), content });
            }
        }
        inputs.sort_by_cached_key(Input::name);
        inputs
    }
}

impl LinkedObject {
    fn open(path: &Path) -> Result<LinkedObject, Report> {
        let name = display(path);
        let refuse = |message: String| {
            let help = "name the objects of a plan: what `lipz pack --shard` writes";
            Report::failure(name.as_str(), Code::NoObject, message, help)
        };
        match export::read(path) {
            Ok(Ok((checksum, export))) => Ok(LinkedObject { path: path.to_owned(), checksum, export }),
            Ok(Err(why)) => Err(refuse(format!("`{name}` is not an object: {why}"))),
            Err(error) => {
                let message = format!("`{name}` cannot be read: {error}");
                Err(Report::about(name.as_str(), Diagnostic::new(Code::UnreadableFile, message)))
            }
        }
    }

    /// The clips, of bytes that are verified first.
    fn read(&self) -> Result<Found, Report> {
        let name = display(&self.path);
        let bytes = std::fs::read(&self.path).map_err(|error| {
            let message = format!("`{name}` cannot be read: {error}");
            Report::about(name.as_str(), Diagnostic::new(Code::UnreadableFile, message))
        })?;
        let utf8 = |bytes| simdutf8::basic::from_utf8(bytes).ok();
        let verified = Bank::open(&bytes).and_then(|bank| bank.verify_with(utf8));
        let bank = verified.map_err(|error| self.damaged(&error.to_string()))?;
        if bank.checksum() != self.checksum {
            return Err(self.damaged("it was replaced meanwhile"));
        }
        if bank.clip_count() != self.export.names.len() {
            return Err(self.damaged("its export table is about other clips"));
        }
        let is_elsewhere = |id| {
            let shards = std::num::NonZero::new(self.export.shards);
            shards.is_none_or(|shards| super::shard_of(id, shards) != self.export.shard)
        };
        if bank.clips().any(|clip| is_elsewhere(clip.id())) {
            return Err(self.damaged("it has a clip of another shard"));
        }
        let recordings = bank.clips().filter_map(|clip| Some((clip.key().to_owned(), clip.recording()?))).collect();
        let clips = clips_of(bytes).ok_or_else(|| self.damaged("its clips cannot be read"))?;
        Ok(Found { clips, recordings })
    }

    fn damaged(&self, why: &str) -> Report {
        let name = display(&self.path);
        let message = format!("the object `{name}` is damaged: {why}");
        Report::failure(name, Code::BankDamaged, message, "pack its shard again")
    }
}

/// What does not belong together among objects in the order of their shards.
fn misfits(objects: &[LinkedObject]) -> Vec<Report> {
    let Some(first) = objects.first() else { return Vec::new() };
    let mut reports = Vec::new();
    let mut refuse = |object: &LinkedObject, message: String, help: &str| {
        reports.push(Report::failure(display(&object.path), Code::ObjectMisfit, message, help));
    };
    for object in objects {
        let (one, other) = (&object.export, &first.export);
        let name = display(&first.path);
        let help = "pack all shards of one plan with one version of lipz";
        if one.lipz != MAKER {
            let (theirs, own) = (escape::text(&one.lipz).into_owned(), MAKER);
            refuse(object, format!("the object was made by lipz {theirs}, and this is lipz {own}"), help);
        } else if one.shards != other.shards || one.shard >= one.shards {
            let message =
                format!("the object is shard {} of {}, but `{name}` is one of {}", one.shard, one.shards, other.shards);
            refuse(object, message, help);
        } else if one.options != other.options || one.settings != other.settings {
            refuse(object, format!("the object was made with other settings than `{name}`"), help);
        }
    }
    if !reports.is_empty() {
        return reports;
    }
    let mut expected = 0;
    let mut missing = Vec::new();
    for object in objects {
        let shard = object.export.shard;
        if shard < expected {
            reports.push(Report::failure(
                display(&object.path),
                Code::ObjectMisfit,
                format!("shard {shard} is there twice"),
                "name each object once",
            ));
            continue;
        }
        missing.extend(expected..shard);
        expected = shard + 1;
    }
    missing.extend(expected..first.export.shards);
    if !missing.is_empty() {
        let shown: Vec<String> = missing.iter().take(10).map(u16::to_string).collect();
        let more = if missing.len() > shown.len() {
            format!(" and {} more", missing.len() - shown.len())
        } else {
            String::new()
        };
        let what = if missing.len() == 1 { "the object of shard" } else { "the objects of shards" };
        let message = format!(
            "{what} {}{more} of {} missing",
            shown.join(", "),
            if missing.len() == 1 {
                format!("{} is", first.export.shards)
            } else {
                format!("{} are", first.export.shards)
            }
        );
        reports.push(Report::failure("", Code::ObjectMissing, message, "name the objects of all shards"));
    }
    reports
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
