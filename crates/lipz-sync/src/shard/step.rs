//! The step of a shard: what is read of its clips, and the mouths that are made of them.

use super::hash_for_sync;
use super::mouths::{MadeMouth, Mouths};
use crate::recordings::shown;
use crate::sync::{New, Place, Step, by_letters, grid_place, work};
use crate::{Job, Recordings, SyncOptions, SyncRecord, jobs_of_clips};
use lipz_compiler::settings::Settings;
use lipz_compiler::shard::{Beside, ContentHash, ShardPlan, WireReport};
use lipz_compiler::{Content, Input};
use lipz_diagnostics::{Code, Diagnostic, DiagnosticsError, Report};
use std::collections::{BTreeMap, HashMap, HashSet};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// What lip sync reads of each of these clips besides its Lipz file, by key: the recordings of the clip and of dubs that have no
/// file yet, what the record says of them, and their TextGrids.
pub fn beside(
    settings: &Settings,
    inputs: &[Input],
    recordings: &Recordings,
    record: &SyncRecord,
) -> HashMap<String, Beside> {
    let file_of: HashMap<&Path, &str> =
        inputs.iter().filter_map(|input| Some((path(input)?, input.key.as_str()))).collect();
    let mut all: HashMap<String, Beside> = HashMap::new();
    for job in jobs_of_clips(inputs, recordings) {
        let original = || job.original.as_ref().and_then(|original| file_of.get(original.lipz_file.as_path()));
        // A dub that has no file yet is with its original.
        let own = file_of.get(job.lipz_file.as_path()).or_else(original);
        let Some(of_clip) = own.map(|key| all.entry((*key).to_owned()).or_default()) else { continue };
        let grid = settings.sync.textgrids.as_deref().map(|folder| grid_place(folder, &job.key));
        of_clip.files.extend(grid.filter(|grid| grid.is_file()));
        // A dub is made with the text and the recording of its original, which need not be an input.
        if let Some(original) = &job.original {
            let is_input = file_of.contains_key(original.lipz_file.as_path());
            of_clip.files.extend((!is_input).then(|| original.lipz_file.clone()));
            of_clip.files.extend(original.recording.clone());
        }
        of_clip.files.push(job.recording);
        let known = hash_for_sync(record, &job.lipz_file);
        of_clip.record = match (of_clip.record, known) {
            (Some(one), Some(other)) => Some(ContentHash::of(format!("{one} {other}").as_bytes())),
            (one, other) => one.or(other),
        };
    }
    for of_clip in all.values_mut() {
        of_clip.files.sort();
        of_clip.files.dedup();
    }
    all
}

/// Makes the mouths of a shard, and writes nothing but what is returned. What is read is what the plan names: a recording that
/// it does not name is none.
///
/// # Errors
/// If the files are not those of the plan.
pub fn mouths(
    plan: &ShardPlan,
    settings: &Settings,
    options: &SyncOptions,
    record: &SyncRecord,
    progress: &(dyn Fn(u32) + Sync),
) -> Result<Mouths, Vec<Report>> {
    let inputs = plan.inputs();
    let planned: HashSet<&Path> = plan.needs().map(Path::new).collect();
    let mut recordings = Recordings::discover(settings).map_err(DiagnosticsError::into_reports)?;
    recordings.retain(|path| planned.contains(path));
    let known = beside(settings, &inputs, &recordings, record);
    let changed = plan.changed(|input| known.get(&input.key).and_then(|beside| beside.record));
    if !changed.is_empty() {
        return Err(changed);
    }
    let jobs = jobs_of_clips(&inputs, &recordings);
    let places = |job: &Job| {
        let grid = settings.sync.textgrids.as_deref().map(|folder| grid_place(folder, &job.key));
        [Some(job.lipz_file.clone()), grid].into_iter().flatten()
    };
    let places = jobs.iter().flat_map(places).filter(|place| !planned.contains(place.as_path()) && place.exists());
    let unplanned: Vec<Report> = places.map(|place| unplanned(&place)).collect();
    if !unplanned.is_empty() {
        return Err(unplanned);
    }
    let made = Made::default();
    let mut mouths = Mouths::new(plan);
    for (job, step, reports) in work(&jobs, options, record, &made, progress) {
        mouths.reports.extend(reports.iter().map(WireReport::of));
        match step {
            Step::Unchanged(listed) => mouths.unchanged.push((job.key.clone(), listed)),
            Step::Kept(kept) => mouths.kept.push((job.key.clone(), kept)),
            Step::Refused => mouths.refused += 1,
            Step::New(new) => mouths.made.push(made_mouth(job, *new, options, record)),
        }
    }
    Ok(mouths)
}

fn made_mouth(job: &Job, new: New, options: &SyncOptions, record: &SyncRecord) -> MadeMouth {
    MadeMouth {
        read_by_letters: by_letters(job, options, &new),
        key: job.key.clone(),
        lipz_file: shown(&job.lipz_file),
        before: new.before.as_deref().map(ContentHash::of),
        after: new.after,
        recording: shown(&job.recording),
        known: hash_for_sync(record, &job.lipz_file),
        line: new.line.written(&record.name(&job.lipz_file)),
        spoken: new.outdated.iter().map(|spoken| spoken.written(&record.name(&job.lipz_file))).collect(),
        listed: new.listed,
        grid: new.grid.map(|(place, text)| (shown(&place), text)),
        has_new_text: new.has_new_text,
        is_dub: job.original.is_some(),
    }
}

/// What was made by now: dubs read the files of their originals as they will be.
#[derive(Default)]
struct Made(Mutex<BTreeMap<PathBuf, String>>);

impl Place for Made {
    fn read(&self, lipz_file: &Path) -> io::Result<Vec<u8>> {
        match self.0.lock().unwrap_or_else(PoisonError::into_inner).get(lipz_file) {
            Some(after) => Ok(after.clone().into_bytes()),
            None => fs::read(lipz_file),
        }
    }

    fn is_closed(&self) -> bool {
        false
    }

    fn put(&self, job: &Job, new: &New) -> Result<(), Option<Report>> {
        let mut files = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        files.insert(job.lipz_file.clone(), new.after.clone());
        Ok(())
    }
}

fn path(input: &Input) -> Option<&Path> {
    match &input.content {
        Content::File(path) => Some(path),
        Content::Bytes { .. } => None,
    }
}

fn unplanned(place: &Path) -> Report {
    let name = shown(place);
    let message = format!("`{name}` was not there when the plan was made");
    let diagnostic = Diagnostic::new(Code::PlanOutdated, message).help("make the plan again: lipz shard plan --sync");
    Report::about(name, diagnostic)
}
