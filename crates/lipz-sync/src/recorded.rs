//! How much of a project is recorded.

use crate::clip::Clip;
use crate::facts::length_us;
use crate::lints::{bytes_of, is_unrecorded};
use crate::{Recordings, SyncRecord, record_place, threads};
use lipz_compiler::settings::Settings;
use lipz_compiler::{Content, Input};
use lipz_diagnostics::{DiagnosticsError, Report};
use std::path::Path;

/// How much of the dialogue of a project is recorded, and what its mouths were made from.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
#[non_exhaustive]
pub struct Recorded {
    /// Clips that have a recording.
    pub clips: usize,
    /// Recordings of clips, dubs that have no clip of their own among them.
    pub recordings: usize,
    /// The lengths of these recordings, in microseconds.
    pub length_us: u64,
    /// Clips with mouth shapes that lack a recording in some language (LZ1701).
    pub missing: usize,
    /// Recordings that no clip uses (LZ1702).
    pub unused: usize,
    /// Clips whose mouths a [`SyncRun`](crate::SyncRun) made.
    pub synced: usize,
    /// Words of those clips that were not clearly heard.
    pub doubtful_words: usize,
}

impl Recorded {
    /// Counts the recordings of a project with these Lipz files; nothing if it has no folder of recordings. Of each recording,
    /// only what tells its length is read.
    ///
    /// # Errors
    /// A diagnostic for each recording or folder that cannot be read, and for the record.
    pub fn count(settings: &Settings, inputs: &[Input]) -> Result<Option<Recorded>, DiagnosticsError> {
        let (recorded, reports) = Recorded::count_with_reports(settings, inputs);
        Ok(DiagnosticsError::check(recorded, reports)?.0)
    }

    /// Counts the recordings that can be read, and reports the others, which count with a length of 0.
    ///
    /// For tools that report everything at once, such as the command `lipz`. All other programs call
    /// [`count`](Recorded::count).
    #[must_use = "the reports say whether recordings are missing"]
    pub fn count_with_reports(settings: &Settings, inputs: &[Input]) -> (Option<Recorded>, Vec<Report>) {
        if settings.audio.folder.is_none() {
            return (None, Vec::new());
        }
        let (recordings, mut reports) = Recordings::discover_with_reports(settings);
        let record = SyncRecord::read(&record_place(settings));
        let record = record.unwrap_or_else(|report| {
            reports.push(report);
            SyncRecord::default()
        });
        let unused = recordings.without_clip(inputs).len() + recordings.beside_others().count();
        let mut all = Recorded { unused, ..Recorded::default() };
        let found = threads::map(inputs, settings.options.get_threads(), |input| {
            of_clip(settings, &recordings, &record, input)
        });
        for (one, of_clip) in found {
            all.add(one);
            reports.extend(of_clip);
        }
        (Some(all), reports)
    }

    fn add(&mut self, other: Recorded) {
        self.clips += other.clips;
        self.recordings += other.recordings;
        self.length_us = self.length_us.saturating_add(other.length_us);
        self.missing += other.missing;
        self.synced += other.synced;
        self.doubtful_words += other.doubtful_words;
    }
}

/// What there is for a clip.
fn of_clip(
    settings: &Settings,
    recordings: &Recordings,
    record: &SyncRecord,
    input: &Input,
) -> (Recorded, Vec<Report>) {
    let own = recordings.find(&input.key);
    let dubs = recordings.dubs(&input.key);
    let files: Vec<&Path> = own.into_iter().chain(dubs.into_iter().filter_map(|(_, path)| path)).collect();
    let mut found = Recorded { clips: usize::from(own.is_some()), recordings: files.len(), ..Recorded::default() };
    let mut reports = Vec::new();
    for path in files {
        match length_us(path) {
            Ok(length_us) => found.length_us = found.length_us.saturating_add(length_us),
            Err(report) => reports.push(report),
        }
    }
    let bytes = bytes_of(input).unwrap_or_default();
    if let Some(document) = lipz_file::parse(&bytes).document {
        let clip = Clip::from_document(&document, &settings.options);
        found.missing = usize::from(is_unrecorded(settings, &clip, recordings, &input.key));
    }
    if let Content::File(lipz_file) = &input.content {
        // After a merge there may be several lines; the last one counts, as for emotions.
        let lines = record.lines_for(lipz_file);
        found.synced = usize::from(!lines.is_empty());
        found.doubtful_words =
            lines.iter().rev().find_map(|line| line.words.as_ref()).map_or(0, lipz_compiler::WordTimes::doubtful_count);
    }
    (found, reports)
}
