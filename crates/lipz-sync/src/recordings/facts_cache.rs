//! A cache of recordings between runs, so that only changed ones are read again.

use crate::recordings::{FileFacts, Recordings};
use crate::threads;
use lipz_bank::Recording;
use lipz_compiler::Input;
use lipz_compiler::settings::Settings;
use lipz_diagnostics::{DiagnosticsError, Report};
use std::collections::{BTreeMap, HashMap};
use std::fs::Metadata;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

/// Some file systems store times with a precision of two seconds. A file that changed so recently may change again
/// without a visible difference.
const COARSEST_TICK: Duration = Duration::from_secs(2);

/// A cache of a project's recordings, for programs that pack repeatedly. Recordings are long, and most of them do not
/// change.
#[derive(Clone, Debug, Default)]
pub struct FactsCache {
    files: HashMap<PathBuf, CachedFacts>,
    read_count: usize,
}

/// A recording that was read.
#[derive(Clone, Copy, Debug)]
struct CachedFacts {
    look: FileTimes,
    /// Whether the file was old enough at that time for every later change to be visible.
    is_settled: bool,
    facts: FileFacts,
}

/// The file's attributes, which are available without reading it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
struct FileTimes {
    length_bytes: u64,
    modified: SystemTime,
    /// The time of the last change of any kind, which programs cannot set, and the inode number.
    #[cfg(unix)]
    changed: (i64, i64, u64),
}

impl FactsCache {
    /// Does the same as [`in_bank`](crate::in_bank()), but only reads recordings that have changed since the last call.
    ///
    /// # Errors
    /// A diagnostic for each recording or folder that cannot be read.
    pub fn in_bank(
        &mut self,
        settings: &Settings,
        inputs: &[Input],
    ) -> Result<BTreeMap<String, Recording>, DiagnosticsError> {
        let (recordings, reports) = self.in_bank_with_reports(settings, inputs);
        Ok(DiagnosticsError::check(recordings, reports)?.0)
    }

    /// Does the same for the readable recordings, and reports the others.
    ///
    /// For tools that report everything at once, such as the command `lipz`. All other programs call
    /// [`in_bank`](FactsCache::in_bank).
    #[must_use = "check the reports for missing recordings"]
    pub fn in_bank_with_reports(
        &mut self,
        settings: &Settings,
        inputs: &[Input],
    ) -> (BTreeMap<String, Recording>, Vec<Report>) {
        if !settings.audio.in_bank {
            self.files.clear();
            self.read_count = 0;
            return Default::default();
        }
        let (recordings, mut reports) = Recordings::discover_with_reports(settings);
        let found: Vec<_> =
            inputs.iter().filter_map(|input| Some((&input.key, recordings.find(&input.key)?))).collect();
        let looked_at = threads::map(&found, settings.options.get_threads(), |(_, path)| self.look_at(path));
        let (mut in_bank, mut files) = (BTreeMap::new(), HashMap::with_capacity(found.len()));
        self.read_count = 0;
        for ((key, path), looked_at) in found.into_iter().zip(looked_at) {
            match looked_at {
                Ok((facts, known, is_read)) => {
                    in_bank.insert(key.clone(), facts.into());
                    files.extend(known.map(|known| (path.to_owned(), known)));
                    self.read_count += usize::from(is_read);
                }
                Err(report) => reports.push(report),
            }
        }
        self.files = files;
        (in_bank, reports)
    }

    /// Returns the number of recordings that the last call read.
    pub fn read_count(&self) -> usize {
        self.read_count
    }

    /// Returns the facts of a recording, the entry for the cache, and whether it was read.
    fn look_at(&self, path: &Path) -> Result<(FileFacts, Option<CachedFacts>, bool), Report> {
        let now = SystemTime::now();
        let look = path.metadata().ok().as_ref().and_then(FileTimes::new);
        if let (Some(look), Some(known)) = (look, self.files.get(path))
            && known.is_settled
            && known.look == look
        {
            return Ok((known.facts, Some(*known), false));
        }
        let facts = FileFacts::read(path)?;
        let known = look.map(|look| CachedFacts { look, is_settled: look.is_settled_at(now), facts });
        Ok((facts, known, true))
    }
}

impl FileTimes {
    fn new(metadata: &Metadata) -> Option<FileTimes> {
        #[cfg(unix)]
        use std::os::unix::fs::MetadataExt;
        Some(FileTimes {
            length_bytes: metadata.len(),
            modified: metadata.modified().ok()?,
            #[cfg(unix)]
            changed: (metadata.ctime(), metadata.ctime_nsec(), metadata.ino()),
        })
    }

    /// Whether any change after `now` will be visible in the attributes.
    fn is_settled_at(&self, now: SystemTime) -> bool {
        #[cfg(unix)]
        let changed = {
            let (seconds, nanoseconds, _) = self.changed;
            let time = |seconds, nanoseconds| Some(Duration::new(u64::try_from(seconds).ok()?, nanoseconds));
            let since = u32::try_from(nanoseconds).ok().and_then(|nanoseconds| time(seconds, nanoseconds));
            since.and_then(|since| SystemTime::UNIX_EPOCH.checked_add(since))
        };
        #[cfg(not(unix))]
        let changed = Some(self.modified);
        changed.and_then(|changed| now.duration_since(changed).ok()).is_some_and(|age| age > COARSEST_TICK)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use std::fs;

    fn wav(path: &Path, samples: u32) {
        let spec = hound::WavSpec {
            channels: 1,
            sample_rate: 8000,
            bits_per_sample: 16,
            sample_format: hound::SampleFormat::Int,
        };
        let mut writer = hound::WavWriter::create(path, spec).unwrap();
        (0..samples).for_each(|_| writer.write_sample(0_i16).unwrap());
        writer.finalize().unwrap();
    }

    #[test]
    fn only_recordings_that_changed_are_read_again() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        let mut settings = Settings::default();
        settings.audio.folder = Some(folder.path().into());
        settings.audio.in_bank = true;
        let inputs = ["a", "b", "c"].map(|key| Input::from_bytes(key, "{}"));
        for name in ["a.wav", "b.wav"] {
            wav(&path(name), 800);
        }
        let mut known = FactsCache::default();
        let mut run = |settings: &Settings| {
            let recordings = known.in_bank(settings, &inputs).unwrap();
            assert_eq!(recordings, crate::recordings::in_bank(settings, &inputs).unwrap(), "as if it were all read");
            (recordings.len(), known.read_count())
        };
        assert_eq!(run(&settings), (2, 2));
        assert_eq!(run(&settings), (2, 2), "a file that was just written may change unseen");
        std::thread::sleep(COARSEST_TICK + Duration::from_millis(100));
        assert_eq!([run(&settings), run(&settings)], [(2, 2), (2, 0)]);
        wav(&path("b.wav"), 1600);
        wav(&path("c.wav"), 80);
        assert_eq!(run(&settings), (3, 2));
        fs::remove_file(path("a.wav")).unwrap();
        assert_eq!(run(&settings), (2, 2));
        fs::write(path("b.wav"), "no sound").unwrap();
        let error = crate::recordings::in_bank(&settings, &inputs).unwrap_err();
        assert!(error.to_string().contains("error[LZ1704]"), "{error}");
        let (recordings, reports) = FactsCache::default().in_bank_with_reports(&settings, &inputs);
        assert_eq!((recordings.len(), reports.as_slice()), (1, error.reports()), "the others are read");
        settings.audio.in_bank = false;
        assert_eq!(run(&settings), (0, 0));
    }
}
