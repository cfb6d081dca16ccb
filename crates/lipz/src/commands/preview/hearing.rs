//! When the phones of a clip are said: heard once more when somebody looks at it, and kept.

use super::version::Version;
use lipz_compiler::settings::Settings;
use lipz_compiler::{Content, Input};
use lipz_diagnostics::Report;
use lipz_sync::{Job, KnownPhones, PhoneTime, SyncOptions, SyncRecord, jobs_of_clips, record_place};
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// What listening to the recordings of a version needs.
#[derive(Default)]
pub(super) struct Hearing {
    settings: Settings,
    known: Arc<KnownPhones>,
    /// Read when the first clip is listened to.
    opened: OnceLock<Result<(SyncOptions, SyncRecord), Report>>,
    /// One clip at a time: whoever goes through the list needs the other cores for what is seen.
    turn: Mutex<()>,
}

/// The phones of clips, by their keys.
pub(super) type Phones = BTreeMap<String, Arc<[PhoneTime]>>;

impl Hearing {
    /// Listens as these settings say; what is `known` from versions before is not heard again.
    pub(super) fn new(settings: Settings, known: Arc<KnownPhones>) -> Hearing {
        Hearing { settings, known, ..Hearing::default() }
    }

    /// The phones of a clip; none of one that was not synced with its recording.
    pub(super) fn phones(&self, version: &Version, key: &str) -> Result<Arc<[PhoneTime]>, Report> {
        let Some(job) = job(version, key) else { return Ok(Arc::default()) };
        let (options, record) = self.opened()?;
        let _turn = self.turn.lock().unwrap_or_else(PoisonError::into_inner);
        self.known.of(&job, options, record)
    }

    /// The phones of all clips, and what could not be read.
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

/// The clip and its recording, if it has one.
fn job(version: &Version, key: &str) -> Option<Job> {
    let content = Content::File(version.files.get(key)?.clone());
    let input = Input { key: key.to_owned(), content };
    jobs_of_clips(&[input], &version.recordings).into_iter().find(|job| job.key == key)
}
