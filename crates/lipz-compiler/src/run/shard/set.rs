//! Linking to a set: the object of each shard becomes a bank, with the same results as in one bank of all clips.
//!
//! Only a few results depend on clips of several lines: the locales, coverage, and clashes of keys. All others depend
//! on a single line, whose clips are in the same shard. Therefore, only one shard at a time is in memory, with the keys
//! of the others.

use super::Link;
use super::linked_object::LinkedObject;
use super::set_files::{SetFiles, SetPart, SetPlace};
use super::shard_of;
use crate::bank::lower::stream::stream;
use crate::bank::lower::{BankExtras, Layout};
use crate::bank::verify::verify;
use crate::clip::Clips;
use crate::files::lock::Lock;
use crate::files::path::display;
use crate::locales::dubs::{self, Dubs, KeptDubs};
use crate::locales::localise;
use crate::project::Options;
use crate::run::Compiler;
use crate::run::compile::{TextFacts, in_file};
use crate::sources::{Input, key};
use crate::util::parallel;
use lipz_bank::ClipId;
use lipz_diagnostics::{Code, Report, reports};
use std::collections::BTreeSet;
use std::io::Cursor;
use std::num::NonZero;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The result of linking to a set.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct LinkedSet {
    /// The files; `None` if there are errors.
    pub files: Option<SetFiles>,
    /// All diagnostics, sorted by file and position.
    pub reports: Vec<Report>,
}

/// The result for one object.
struct ObjectResult {
    inputs: Vec<Input>,
    reports: Vec<Report>,
    texts: TextFacts,
    /// `None` if there are errors.
    bank: Option<SetPart>,
}

impl Compiler<'_> {
    /// Links the objects of all shards to a set: a bank for each next to the index at `path`, which is written last, so
    /// that either the old set or the new one is complete at all times. Diagnostics and answers are those of
    /// [`link`](Compiler::link). Each thread has one object in memory at a time. Concurrent runs that link to the same
    /// path are serialised.
    pub fn link_to_set(&self, link: &Link, path: &Path) -> LinkedSet {
        let options = match self.options.canonical() {
            Ok(options) => options,
            Err(report) => return LinkedSet { reports: vec![report], ..LinkedSet::default() },
        };
        let shards = link.objects.len() as u16;
        let place = link.with_options(&options).and_then(|()| SetPlace::new(path, shards));
        // Finishing removes banks that no index names, which would include new ones of a concurrent run.
        let locked = place.and_then(|place| Ok((Lock::wait(path)?, place)));
        let linked =
            locked.map(|(_lock, place)| parallel::in_pool(options.threads, || self.set(link, &place, &options)));
        linked.unwrap_or_else(|report| LinkedSet { reports: vec![report], ..LinkedSet::default() })
    }

    fn set(&self, link: &Link, place: &SetPlace<'_>, options: &Options) -> LinkedSet {
        let (parts, mut reports) = self.parts(link, place, options);
        let (mut inputs, mut banks, mut texts) = (Vec::new(), Vec::new(), TextFacts::default());
        for part in parts {
            inputs.extend(part.inputs);
            reports.extend(part.reports);
            texts.add(part.texts);
            banks.extend(part.bank);
        }
        inputs.sort_by(|one, other| one.shown_name().cmp(&other.shown_name()));
        let mut of_keys = Vec::new();
        key::check(&inputs, &mut of_keys);
        of_keys.iter_mut().for_each(|report| options.apply_levels(report));
        reports.splice(..0, of_keys);
        let mut finished = Ok(None);
        if !reports::have_errors(&reports) {
            finished = texts.check_coverage(options).and_then(|()| {
                reports.push(texts.judged(options));
                if reports::have_errors(&reports) {
                    return Ok(None);
                }
                let moved = moved(&inputs, options, banks.len() as u16)?;
                self.write_guarded(place.index, || place.finish(banks.clone(), &moved)).map(Some)
            });
        }
        let files = finished.unwrap_or_else(|report| {
            reports.push(report);
            None
        });
        if files.is_none() {
            banks.iter().for_each(SetPart::withdraw);
        }
        reports::sort(&mut reports);
        LinkedSet { files, reports }
    }

    /// Returns the result for each object, sorted by shard, and the diagnostics.
    fn parts(&self, link: &Link, place: &SetPlace<'_>, options: &Options) -> (Vec<ObjectResult>, Vec<Report>) {
        // Each bank has the locales of all objects.
        let tags: BTreeSet<&str> =
            link.objects.iter().flat_map(|object| &object.export.locales).map(String::as_str).collect();
        let tags: Vec<Box<str>> = tags.into_iter().map(Box::from).collect();
        let next = AtomicUsize::new(0);
        let workers = parallel::workers(options.threads, || {
            let mut done = Vec::new();
            while let Some(object) = link.objects.get(next.fetch_add(1, Ordering::Relaxed)) {
                done.push((object.export.shard, self.part(object, place, &tags, options)));
                (self.progress)(object.export.names.len() as u64);
            }
            done
        });
        let mut done: Vec<_> = workers.into_iter().flatten().collect();
        done.sort_by_key(|(shard, _)| *shard);
        let (mut parts, mut faults) = (Vec::new(), Vec::new());
        for (_, part) in done {
            match part {
                Ok(part) => parts.push(part),
                Err(report) => faults.push(report),
            }
        }
        (parts, faults)
    }

    /// Makes the bank of an object with the locales `tags`, and writes it.
    fn part(
        &self,
        object: &LinkedObject,
        place: &SetPlace<'_>,
        tags: &[Box<str>],
        options: &Options,
    ) -> Result<ObjectResult, Report> {
        let (clips, recordings) = object.read(&options.voices, true, &mut Vec::new())?;
        let inputs: Vec<Input> = object.inputs(&clips).collect();
        let mut reports = object.reports()?;
        let options = Options { recordings, ..options.clone() };
        let batches = vec![clips];
        let of_dubs = dubs::compare(&batches, &inputs, &options, &KeptDubs::default());
        reports.extend(of_dubs.into_iter().map(|(_, report)| report));
        let mut part = ObjectResult { inputs, reports, texts: TextFacts::default(), bank: None };
        if reports::have_errors(&part.reports) {
            return Ok(part);
        }
        let bytes = bank(batches, tags, &options).map_err(|report| in_file(report, &part.inputs))?;
        let bytes = bytes.ok_or_else(|| object.changed())?;
        verify(&bytes)?;
        part.texts = TextFacts::of(&bytes, &options);
        let written = self.write_guarded(place.index, || place.write(object.export.shard, &bytes))?;
        Ok(ObjectResult { bank: Some(written), ..part })
    }
}

/// Returns the bank of the clips of a shard; `None` if their object has been modified.
fn bank(mut batches: Vec<Clips>, tags: &[Box<str>], options: &Options) -> Result<Option<Vec<u8>>, Report> {
    batches.iter_mut().for_each(|clips| clips.refer_to(tags));
    let clips = Clips::by_key(&batches);
    let dubs = Dubs::find(&clips, options, &KeptDubs::default());
    let localised = localise::localise(&clips, tags, &dubs, options);
    let layout = Layout::new(&clips, &localised, &dubs, BankExtras::of(options))?;
    drop((clips, localised, dubs));
    let mut bank = Cursor::new(Vec::new());
    stream(&layout, &batches, &mut bank, false).map_err(|fault| fault.into_report(Path::new("")))?;
    Ok(batches.iter().all(Clips::is_as_it_was).then(|| bank.into_inner()))
}

/// Returns the clips that are in a different bank than their ids imply, because dubs are in the bank of their line.
fn moved(inputs: &[Input], options: &Options, shards: u16) -> Result<Vec<(u64, u16)>, Report> {
    let Some(shards) = NonZero::new(shards) else { return Ok(Vec::new()) };
    let mut all: Vec<(u64, u16, &Input)> = inputs
        .iter()
        .map(|input| {
            let home = super::shard_of_key(&input.key, &options.voices, shards);
            (ClipId::from_key(&input.key).get(), home, input)
        })
        .collect();
    all.sort_unstable_by_key(|(id, ..)| *id);
    if let Some([(id, _, one), (_, _, next)]) = all.array_windows().find(|[(one, ..), (next, ..)]| one == next) {
        let message = format!("the keys `{}` and `{}` have the same clip id, {id:016x}", one.key, next.key);
        return Err(Report::failure(
            display(Path::new(&next.name())),
            Code::IdCollision,
            message,
            "rename one of the two",
        ));
    }
    let is_moved = |(id, home, _): &(u64, u16, &Input)| shard_of(ClipId::from_u64(*id), shards) != *home;
    Ok(all.into_iter().filter(is_moved).map(|(id, home, _)| (id, home)).collect())
}
