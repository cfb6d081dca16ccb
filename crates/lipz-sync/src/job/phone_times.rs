//! The times of a clip's phones. The record only has the times of words, so the recording is analysed again.

use crate::job::loaded::LoadedJob;
use crate::job::run::with_loaded;
use crate::job::store::ReadOnlyClips;
use crate::job::{Job, SyncOptions};
use crate::record::{MouthHashes, SyncRecord};
use crate::threads;
use lipz_diagnostics::Report;
use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

/// A phone of speech, with its times.
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub struct PhoneTime {
    /// Its ARPAbet name: `AA`, `CH`.
    pub phone: String,
    /// The start, in milliseconds from the start of the recording.
    pub start_ms: u32,
    /// The end, in milliseconds.
    pub end_ms: u32,
}

/// A cache of the phones of clips, for repeated queries. A clip is only analysed again when its recording, text or
/// settings change.
#[derive(Debug, Default)]
pub struct PhoneTimeCache {
    by_content: Mutex<HashMap<Content, Arc<[PhoneTime]>>>,
}

/// The hashes of recording, text, and settings with the TextGrid.
type Content = (u64, u64, u64);

impl PhoneTimeCache {
    /// Returns the times of a clip's phones, from its TextGrid if it has one, otherwise from an alignment. Returns none
    /// if the visemes were not made from this recording and this text, or if they follow the loudness.
    ///
    /// # Errors
    /// If a file cannot be read.
    pub fn of(&self, job: &Job, options: &SyncOptions, record: &SyncRecord) -> Result<Arc<[PhoneTime]>, Report> {
        // `check` reports the other problems of the clip.
        with_loaded(job, options, (record, &ReadOnlyClips), &mut Vec::new(), |mut loaded, reports| {
            self.of_loaded(&mut loaded, reports)
        })
    }

    /// Returns the same for many clips, with as many threads as the options state.
    ///
    /// # Errors
    /// The files that could not be read, in the order of the jobs.
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

    fn of_loaded(&self, loaded: &mut LoadedJob<'_>, reports: &mut Vec<Report>) -> Result<Arc<[PhoneTime]>, Report> {
        if !loaded.has_phones() {
            return Ok(Arc::default());
        }
        let MouthHashes { sound, text, settings, .. } = loaded.made;
        let lock = || self.by_content.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(known) = lock().get(&(sound, text, settings)) {
            return Ok(Arc::clone(known));
        }
        let phones = loaded.phones(reports)?;
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
