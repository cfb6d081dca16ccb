//! Recordings become mouths of Lipz files.

pub(crate) mod grid;
pub(crate) mod hashes;
mod jobs;
pub(crate) mod listed;
mod model_file;
pub(crate) mod mouth;
mod one;
mod options;
mod phones;
mod progress;
mod record;
mod run;
mod said;
mod spoken;
mod subject;
mod target;
mod train;

pub(crate) use grid::place as grid_place;
pub use grid::{CodesOfPhones, codes_of_phones};
pub use jobs::{Job, Original, jobs_of_clips, jobs_of_recordings_with_reports};
pub use model_file::{model_at, write_model};
pub use one::Kept;
pub use options::SyncOptions;
pub(crate) use options::{spoken_string, spoken_text};
pub use phones::{KnownPhones, PhoneTime};
pub use progress::JOB_PARTS;
pub use record::{Line, Made, OriginalThen, RECORD_NAME, SyncRecord, record_place};
pub use run::SyncRun;
pub use said::{Said, SaidTiers};
pub use spoken::Spoken;
pub use train::{TRAINING_ROUNDS, Trained, train};

use crate::threads;
use lipz_compiler::{replace_file, rewrite_file};
use lipz_diagnostics::{Code, Report};
use lipz_speech::{Language, Reliance};
use listed::Listings;
use one::one;
pub(crate) use one::{New, Step, hash_of};
use progress::Progress;
use std::collections::BTreeSet;
use std::path::Path;
use std::{fs, io};

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

impl Synced {
    /// Ends a run: the record is written as a whole.
    pub(crate) fn end(mut self, listed: Listings, record: &SyncRecord, whole: &Whole<'_>) -> Synced {
        listed.tell(&mut self);
        let mut written = Ok(());
        whole(&mut || written = record.write());
        self.reports.extend(written.err());
        lipz_diagnostics::reports::sort(&mut self.reports);
        self
    }
}

/// Where Lipz files come from while mouths are made, and where those go.
pub(crate) trait Place: Sync {
    /// The bytes of a Lipz file, with the mouth that it has got by now.
    fn read(&self, lipz_file: &Path) -> io::Result<Vec<u8>>;

    /// Whether nothing can be put there any more.
    fn is_closed(&self) -> bool;

    /// Puts what was made of a job there. An error that was told before is none to tell.
    fn put(&self, job: &Job, new: &New) -> Result<(), Option<Report>>;
}

/// Does jobs on as many threads as the options say: originals first, because dubs borrow their texts.
pub(crate) fn work<'j>(
    jobs: &'j [Job],
    options: &SyncOptions,
    record: &SyncRecord,
    place: &dyn Place,
    progress: &(dyn Fn(u32) + Sync),
) -> Vec<(&'j Job, Step, Vec<Report>)> {
    let (originals, dubs): (Vec<&Job>, Vec<&Job>) = jobs.iter().partition(|job| job.original.is_none());
    let make = |job: &&'j Job| {
        let (mut reports, progress) = (Vec::new(), Progress::new(progress));
        let mut step = match place.is_closed() {
            false => one(job, options, (record, place), &progress, &mut reports),
            true => Step::Refused,
        };
        if let Step::New(new) = &step
            && let Err(report) = place.put(job, new)
        {
            reports.extend(report);
            step = Step::Refused;
        }
        progress.finish();
        (*job, step, reports)
    };
    let mut done = threads::map(&originals, options.options.get_threads(), make);
    done.extend(threads::map(&dubs, options.options.get_threads(), make));
    done
}

/// The locale of the words of a mouth, if its language has no rules of its own.
pub(crate) fn by_letters(job: &Job, options: &SyncOptions, new: &New) -> Option<String> {
    let is_read_by_letters =
        |locale: &&str| Language::from_locale(locale).is_some_and(|language| language.reliance() == Reliance::Letters);
    options.locale_of(job).filter(|_| new.line.words.is_some()).filter(is_read_by_letters).map(str::to_owned)
}

/// The Lipz files themselves, which are read only.
pub(crate) struct OnDisk;

impl Place for OnDisk {
    fn read(&self, lipz_file: &Path) -> io::Result<Vec<u8>> {
        fs::read(lipz_file)
    }

    fn is_closed(&self) -> bool {
        true
    }

    fn put(&self, _job: &Job, _new: &New) -> Result<(), Option<Report>> {
        Err(None)
    }
}

/// Why a mouth is not written.
pub(crate) struct Fault {
    pub(crate) report: Report,
    /// Because its line cannot be.
    is_of_record: bool,
}

/// Writes a line of the record, then the file, which had these bytes `before`, and the TextGrid.
pub(crate) fn write(
    lipz_file: &Path,
    before: Option<&[u8]>,
    after: &str,
    (line, spoken, grid): (&Line, &[Spoken], Option<(&Path, &str)>),
    record: &SyncRecord,
    whole: &Whole<'_>,
) -> Result<(), Fault> {
    let mut written = Ok(());
    whole(&mut || {
        if let Err(report) = record.append(lipz_file, line, spoken) {
            written = Err(Fault { report, is_of_record: true });
            return;
        }
        let file = match before {
            Some(before) => rewrite_file(lipz_file, before, after.as_bytes()),
            None if lipz_file.exists() => Err(Report::failure(
                crate::recordings::shown(lipz_file),
                Code::OutputFailed,
                "another program has made the file in the meantime",
                "run the command again",
            )),
            None => replace_file(lipz_file, after.as_bytes()),
        };
        // One that has come into being meanwhile is somebody's work.
        let grid = grid.filter(|(place, _)| !place.exists());
        let write_grid = || grid.map_or(Ok(()), |(place, text)| replace_file(place, text.as_bytes()));
        written = file.and_then(|()| write_grid()).map_err(|report| Fault { report, is_of_record: false });
    });
    written
}
