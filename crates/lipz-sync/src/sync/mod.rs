//! Recordings become mouths of Lipz files.

pub(crate) mod grid;
pub(crate) mod hashes;
mod jobs;
mod listed;
mod model_file;
pub(crate) mod mouth;
mod one;
mod options;
mod phones;
mod progress;
mod record;
mod said;
mod subject;
mod target;
mod train;

pub use grid::{CodesOfPhones, codes_of_phones};
pub use jobs::{Job, Original, jobs_of_clips, jobs_of_recordings};
pub use model_file::{model_at, write_model};
pub use one::Kept;
pub use options::SyncOptions;
pub(crate) use options::{spoken_string, spoken_text};
pub use phones::{KnownPhones, PhoneTime};
pub use progress::JOB_PARTS;
pub use record::{Line, Made, OriginalThen, RECORD_NAME, SyncRecord, record_place};
pub use said::{Said, SaidTiers};
pub use train::{TRAINING_ROUNDS, Trained, train};

use crate::threads;
use lipz_compiler::{replace_file, rewrite_file};
use lipz_diagnostics::{Code, Report};
use lipz_speech::{Language, Reliance};
use one::{New, Step, one};
use progress::Progress;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::atomic::{AtomicBool, Ordering};

/// What a run did, clip by clip in the order of the jobs, originals before dubs.
#[derive(Debug, Default)]
#[non_exhaustive]
pub struct Synced {
    /// The keys of the clips that got a mouth.
    pub made: Vec<String>,
    /// How many mouths are what they would become.
    pub unchanged: usize,
    /// The keys of the clips whose mouths stay, because somebody made or changed them by hand.
    pub kept: Vec<(String, Kept)>,
    /// How many clips could not be made.
    pub refused: usize,
    /// The keys of those clips that got a mouth for another text than before, from the same recording: its actor may have to say
    /// the new words.
    pub with_new_text: Vec<String>,
    /// Locales of those texts whose languages lipz has no rules for: their words are read letter by letter.
    pub read_by_letters: BTreeSet<String>,
    /// Words that somebody should listen to.
    pub doubtful: Vec<DoubtfulWord>,
    /// Words whose pronunciation is a guess, with it, as lines of a lexicon: each once, in the order of the letters.
    pub guessed: Vec<String>,
    /// The same of the clips whose mouths are what they would become.
    pub doubtful_before: Vec<DoubtfulWord>,
    /// Guesses of these clips that are not among the others.
    pub guessed_before: Vec<String>,
    /// Everything that was found.
    pub reports: Vec<Report>,
}

/// A word of which nobody is sure that it is said there.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct DoubtfulWord {
    /// The key of the clip.
    pub key: String,
    /// Where it was looked for, in microseconds.
    pub start_us: u64,
    /// The word.
    pub word: String,
}

/// How files are written: runs what it gets, and lets nothing end the process meanwhile.
pub type Whole<'w> = dyn Fn(&mut dyn FnMut()) + Sync + 'w;

/// Makes the mouths of these jobs, on as many threads as the options say, and writes each file when its mouth is made. The
/// files are the same, however many threads there are.
///
/// A file that exists gets only `visemes`, `viseme_type` and `fps`; all else stays, and the `|` of its text move with the
/// words. What `record` knows of is not made again unless recording, text or settings changed, and mouths that were changed by
/// hand stay (see [`SyncOptions::force`]). The record is written whenever a file is, so that an interrupted run goes on where
/// it ended. `progress` is told how many more parts of a job are done, of which each job has [`JOB_PARTS`].
///
/// ```no_run
/// use lipz_compiler::settings::Settings;
/// use lipz_sync::{Recordings, SyncOptions, SyncRecord, jobs_of_clips, record_place, sync};
/// let (settings, _) = Settings::read("lipz.toml".as_ref());
/// let (inputs, _) = settings.discover();
/// let (recordings, _) = Recordings::discover(&settings);
/// let (options, _) = SyncOptions::new(&settings)?;
/// let (mut record, _) = SyncRecord::read(&record_place(&settings))?;
/// let jobs = jobs_of_clips(&inputs, &recordings);
/// let synced = sync(&jobs, &options, &mut record, &|_| (), &|write| write());
/// println!("{} mouths made, {} kept", synced.made.len(), synced.kept.len());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn sync(
    jobs: &[Job],
    options: &SyncOptions,
    record: &mut SyncRecord,
    progress: &(dyn Fn(u32) + Sync),
    whole: &Whole<'_>,
) -> Synced {
    let known = &*record;
    // Without the record, no mouth may be written: one clip says so, the others need not be made.
    let has_no_record = AtomicBool::new(false);
    // Dubs borrow the texts of originals, which must be there.
    let (originals, dubs): (Vec<&Job>, Vec<&Job>) = jobs.iter().partition(|job| job.original.is_none());
    let make = |job: &&Job| {
        let (mut reports, progress) = (Vec::new(), Progress::new(progress));
        let mut step = match has_no_record.load(Ordering::Relaxed) {
            false => one(job, options, known, &progress, &mut reports),
            true => Step::Refused,
        };
        if let Step::New(new) = &step
            && let Err(report) = write(job, new, known, &has_no_record, whole)
        {
            reports.extend(report);
            step = Step::Refused;
        }
        progress.finish();
        (step, reports)
    };
    let mut done = threads::map(&originals, options.options.threads, make);
    done.extend(threads::map(&dubs, options.options.threads, make));
    let (mut synced, mut guessed, mut guessed_before) = (Synced::default(), BTreeMap::new(), BTreeMap::new());
    let doubtful = |job: &Job, words: Vec<(u64, String)>| {
        let key = job.key.clone();
        words.into_iter().map(move |(start_us, word)| DoubtfulWord { key: key.clone(), start_us, word })
    };
    for (job, (step, reports)) in originals.iter().chain(&dubs).zip(done) {
        synced.reports.extend(reports);
        match step {
            Step::Unchanged(listed) => {
                synced.unchanged += 1;
                synced.doubtful_before.extend(doubtful(job, listed.doubtful));
                guessed_before.extend(listed.guessed);
            }
            Step::Kept(kept) => synced.kept.push((job.key.clone(), kept)),
            Step::Refused => synced.refused += 1,
            Step::New(new) => {
                let locale =
                    options.locale_of(job).filter(|locale| new.line.words.is_some() && is_read_by_letters(locale));
                synced.read_by_letters.extend(locale.map(str::to_owned));
                record.set(&job.lipz_file, new.line);
                synced.made.push(job.key.clone());
                synced.with_new_text.extend(new.has_new_text.then(|| job.key.clone()));
                synced.doubtful.extend(doubtful(job, new.listed.doubtful));
                guessed.extend(new.listed.guessed);
            }
        }
    }
    guessed_before.retain(|word, _| !guessed.contains_key(word));
    synced.guessed_before = guessed_before.into_values().collect();
    synced.guessed = guessed.into_values().collect();
    let mut written = Ok(());
    whole(&mut || written = record.write());
    synced.reports.extend(written.err());
    lipz_diagnostics::reports::sort(&mut synced.reports);
    synced
}

/// Whether the language of a locale has no rules of its own.
fn is_read_by_letters(locale: &str) -> bool {
    Language::from_locale(locale).is_some_and(|language| language.reliance() == Reliance::Letters)
}

/// Writes a file and its line of the record. If that cannot be written, only the first file says so.
fn write(
    job: &Job,
    new: &New,
    record: &SyncRecord,
    has_no_record: &AtomicBool,
    whole: &Whole<'_>,
) -> Result<(), Option<Report>> {
    let mut written = Ok(());
    whole(&mut || {
        if let Err(report) = record.append(&job.lipz_file, &new.line) {
            written = Err((!has_no_record.swap(true, Ordering::Relaxed)).then_some(report));
            return;
        }
        let file = match &new.before {
            Some(before) => rewrite_file(&job.lipz_file, before, new.after.as_bytes()),
            None if job.lipz_file.exists() => Err(Report::failure(
                crate::recordings::shown(&job.lipz_file),
                Code::OutputFailed,
                "another program has made the file in the meantime",
                "run the command again",
            )),
            None => replace_file(&job.lipz_file, new.after.as_bytes()),
        };
        // One that has come into being meanwhile is somebody's work.
        let grid = new.grid.as_ref().filter(|(place, _)| !place.exists());
        let write_grid = || grid.map_or(Ok(()), |(place, text)| replace_file(place, text.as_bytes()));
        written = file.and_then(|()| write_grid()).map_err(Some);
    });
    written
}
