//! Times of the phones of a clip: computed from the recording when the clip is opened, then cached.

use super::version::Version;
use lipz_compiler::settings::Settings;
use lipz_compiler::{Content, Input};
use lipz_diagnostics::Report;
use lipz_sync::{Job, PhoneTime, PhoneTimeCache, SyncOptions, SyncRecord, jobs_of_clips, record_place};
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// The requirements for aligning the recordings of a version.
#[derive(Default)]
pub(super) struct Hearing {
    settings: Settings,
    known: Arc<PhoneTimeCache>,
    /// Read when the first clip is opened.
    opened: OnceLock<Result<(SyncOptions, SyncRecord), Report>>,
    /// Allows one clip at a time, so that the other cores stay free for the page while the user browses clips.
    turn: Mutex<()>,
}

/// The phones of clips, by clip key.
pub(super) type Phones = BTreeMap<String, Arc<[PhoneTime]>>;

impl Hearing {
    /// Prepares the alignment with these settings. Phones that are `known` from earlier versions are not computed
    /// again.
    pub(super) fn new(settings: Settings, known: Arc<PhoneTimeCache>) -> Hearing {
        Hearing { settings, known, ..Hearing::default() }
    }

    /// Returns the phones of a clip; none if it was not synced with its recording.
    pub(super) fn phones(&self, version: &Version, key: &str) -> Result<Arc<[PhoneTime]>, Report> {
        let Some(job) = job(version, key) else { return Ok(Arc::default()) };
        let (options, record) = self.opened()?;
        let _turn = self.turn.lock().unwrap_or_else(PoisonError::into_inner);
        self.known.of(&job, options, record)
    }

    /// Returns the phones of all clips, and the reports about recordings that could not be read.
    pub(super) fn all(&self, version: &Version, progress: &(dyn Fn() + Sync)) -> (Phones, Vec<Report>) {
        let jobs: Vec<Job> = version.files.keys().filter_map(|key| job(version, key)).collect();
        if jobs.is_empty() {
            return Default::default();
        }
        let (options, record) = match self.opened() {
            Ok(opened) => opened,
            Err(report) => return (Phones::new(), vec![report]),
        };
        let (mut phones, mut reports) = (Phones::new(), Vec::new());
        for (job, heard) in jobs.iter().zip(self.known.of_all(&jobs, options, record, progress)) {
            match heard {
                Ok(heard) => drop(phones.insert(job.key.clone(), heard)),
                Err(report) => reports.push(report),
            }
        }
        (phones, reports)
    }

    fn opened(&self) -> Result<&(SyncOptions, SyncRecord), Report> {
        let open = || {
            let (options, _) = SyncOptions::new_with_report(&self.settings)?;
            let record = SyncRecord::read(&record_place(&self.settings))?;
            Ok((options, record))
        };
        self.opened.get_or_init(open).as_ref().map_err(Clone::clone)
    }
}

/// Returns the clip and its recording, if it has one.
fn job(version: &Version, key: &str) -> Option<Job> {
    let content = Content::File(version.files.get(key)?.clone());
    let input = Input { key: key.to_owned(), content };
    jobs_of_clips(&[input], &version.recordings).into_iter().find(|job| job.key == key)
}
