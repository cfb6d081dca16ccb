//! When the phones of a clip are said: the record of mouths has words only, so the recording is heard once more.

use super::one::with_subject;
use super::record::Made;
use super::subject::Subject;
use super::{Job, OnDisk, SyncOptions, SyncRecord};
use crate::threads;
use lipz_diagnostics::Report;
use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

/// A sound of speech, and when it is said.
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub struct PhoneTime {
    /// Its ARPAbet name: `AA`, `CH`.
    pub phone: String,
    /// Its start, in milliseconds from that of the recording.
    pub start_ms: u32,
    /// Its end.
    pub end_ms: u32,
}

/// The phones of clips as they were heard, for programs that ask again and again: nothing is heard twice while recording, text
/// and settings are the same.
#[derive(Debug, Default)]
pub struct KnownPhones {
    by_content: Mutex<HashMap<Content, Arc<[PhoneTime]>>>,
}

/// Hashes of recording, text, and settings with the TextGrid.
type Content = (u64, u64, u64);

impl KnownPhones {
    /// When the phones of this clip are said: as its TextGrid tells if it has one, otherwise as an alignment finds them. None of
    /// a clip whose mouth was not made of this recording and this text, and of one that follows the loudness.
    ///
    /// # Errors
    /// If a file cannot be read.
    pub fn of(&self, job: &Job, options: &SyncOptions, record: &SyncRecord) -> Result<Arc<[PhoneTime]>, Report> {
        // What is odd about the clip is for `check`.
        with_subject(job, options, (record, &OnDisk), &mut Vec::new(), |mut subject, reports| {
            self.of_subject(&mut subject, reports)
        })
    }

    /// The same of many clips, on as many threads as the options say.
    ///
    /// # Errors
    /// What could not be read, in the order of the jobs.
    pub fn of_all(
        &self,
        jobs: &[Job],
        options: &SyncOptions,
        record: &SyncRecord,
        progress: &(dyn Fn() + Sync),
    ) -> Vec<Result<Arc<[PhoneTime]>, Report>> {
        threads::map(jobs, options.options.get_threads(), |job| {
            let phones = self.of(job, options, record);
            progress();
            phones
        })
    }

    fn of_subject(&self, subject: &mut Subject<'_>, reports: &mut Vec<Report>) -> Result<Arc<[PhoneTime]>, Report> {
        if !subject.has_phones() {
            return Ok(Arc::default());
        }
        let Made { sound, text, settings, .. } = subject.made;
        let lock = || self.by_content.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(known) = lock().get(&(sound, text, settings)) {
            return Ok(Arc::clone(known));
        }
        let phones = subject.phones(reports)?;
        let ms = |us: u64| u32::try_from(us / 1000).unwrap_or(u32::MAX);
        let spoken = phones.iter().filter(|phone| phone.phone.is_speech());
        let phones: Arc<[PhoneTime]> = spoken
            .map(|phone| PhoneTime {
                phone: phone.phone.to_string(),
                start_ms: ms(phone.start_us),
                end_ms: ms(phone.end_us),
            })
            .collect();
        lock().insert((sound, text, settings), Arc::clone(&phones));
        Ok(phones)
    }
}
