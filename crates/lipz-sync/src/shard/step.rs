//! The step of a shard: the files that it reads for its clips, and the visemes that it makes.

use super::hash_for_sync;
use super::mouths::{KeptMouth, KeptWords, MadeMouth, Mouths};
use crate::job::grid::place as grid_place;
use crate::job::outcome::{JobOutcome, NewMouth};
use crate::job::store::ClipStore;
use crate::job::work::{by_letters, work};
use crate::job::{Job, SyncOptions, jobs_of_clips};
use crate::record::SyncRecord;
use crate::recordings::Recordings;
use crate::recordings::paths::shown;
use lipz_compiler::settings::Settings;
use lipz_compiler::shard::{ContentHash, ExtraInputs, ShardPlan, WireReport};
use lipz_compiler::{Content, Input};
use lipz_diagnostics::{Code, Diagnostic, DiagnosticsError, Report};
use std::collections::{BTreeMap, HashMap, HashSet};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// Returns the additional inputs of lip sync for each of these clips, by key: the recordings of the clip and of dubs
/// without a file, their lines in the record, and their TextGrids.
pub fn beside(
    settings: &Settings,
    inputs: &[Input],
    recordings: &Recordings,
    record: &SyncRecord,
) -> HashMap<String, ExtraInputs> {
    let file_of: HashMap<&Path, &str> =
        inputs.iter().filter_map(|input| Some((path(input)?, input.key.as_str()))).collect();
    let mut all: HashMap<String, ExtraInputs> = HashMap::new();
    for job in jobs_of_clips(inputs, recordings) {
        let original = || job.original.as_ref().and_then(|original| file_of.get(original.lipz_file.as_path()));
        // A dub without a file belongs to its original.
        let own = file_of.get(job.lipz_file.as_path()).or_else(original);
        let Some(of_clip) = own.map(|key| all.entry((*key).to_owned()).or_default()) else { continue };
        let grid = settings.sync.textgrids.as_deref().map(|folder| grid_place(folder, &job.key));
        of_clip.files.extend(grid.filter(|grid| grid.is_file()));
        // A dub also depends on the text and the recording of its original, which may not be an input.
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

/// Makes the visemes of a shard, and returns them without writing files. Only files in the plan are read; recordings
/// that it does not name are ignored.
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
    let made = MouthsSoFar::default();
    let mut mouths = Mouths::new(plan);
    for (job, step, reports) in work(&jobs, options, record, &made, progress) {
        mouths.reports.extend(reports.iter().map(WireReport::of));
        match step {
            JobOutcome::Unchanged(listed) => mouths.unchanged.push((job.key.clone(), listed)),
            JobOutcome::Kept(reason, words) => {
                let words = words.map(|words| KeptWords {
                    lipz_file: shown(&job.lipz_file),
                    sound: words.sound,
                    words: words.words.to_string(),
                });
                mouths.kept.push(KeptMouth { key: job.key.clone(), reason, words });
            }
            JobOutcome::Refused => mouths.refused += 1,
            JobOutcome::New(new) => mouths.made.push(made_mouth(job, *new, options, record)),
        }
    }
    Ok(mouths)
}

fn made_mouth(job: &Job, new: NewMouth, options: &SyncOptions, record: &SyncRecord) -> MadeMouth {
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

/// The results so far. Dubs read the new files of their originals.
#[derive(Default)]
struct MouthsSoFar(Mutex<BTreeMap<PathBuf, String>>);

impl ClipStore for MouthsSoFar {
    fn read(&self, lipz_file: &Path) -> io::Result<Vec<u8>> {
        match self.0.lock().unwrap_or_else(PoisonError::into_inner).get(lipz_file) {
            Some(after) => Ok(after.clone().into_bytes()),
            None => fs::read(lipz_file),
        }
    }

    fn is_closed(&self) -> bool {
        false
    }

    fn put(&self, job: &Job, new: &NewMouth) -> Result<(), Option<Report>> {
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
    let message = format!("`{name}` did not exist when the plan was made");
    let diagnostic =
        Diagnostic::new(Code::PlanOutdated, message).help("make the plan again with `lipz shard plan sync`");
    Report::about(name, diagnostic)
}
