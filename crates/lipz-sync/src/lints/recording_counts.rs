//! Counts of a project's recordings.

use crate::lints::is_unrecorded;
use crate::record::{SyncRecord, record_place};
use crate::recordings::Recordings;
use crate::recordings::clip::ClipMouth;
use crate::recordings::file_facts::length_us;
use crate::recordings::inputs::bytes_of;
use crate::threads;
use lipz_compiler::settings::Settings;
use lipz_compiler::{Content, Input};
use lipz_diagnostics::{DiagnosticsError, Report};
use std::path::Path;

/// Counts of a project's recordings, and of the visemes made from them.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
#[non_exhaustive]
pub struct RecordingCounts {
    /// The number of clips with a recording.
    pub clips: usize,
    /// The number of recordings of clips, including dubs without a clip of their own.
    pub recordings: usize,
    /// The total length of these recordings, in microseconds.
    pub length_us: u64,
    /// The number of clips with visemes that lack a recording in some language (LZ1701).
    pub missing: usize,
    /// The number of recordings without a clip (LZ1702).
    pub unused: usize,
    /// The number of clips whose visemes were made by a [`SyncRun`](crate::SyncRun).
    pub synced: usize,
    /// The number of unclear words in those clips.
    pub doubtful_words: usize,
}

impl RecordingCounts {
    /// Counts the recordings of a project with these Lipz files; `None` if it has no folder of recordings. Only as much
    /// of each recording is read as its length requires.
    ///
    /// # Errors
    /// A diagnostic for each recording or folder that cannot be read, and for the record.
    pub fn count(settings: &Settings, inputs: &[Input]) -> Result<Option<RecordingCounts>, DiagnosticsError> {
        let (recorded, reports) = RecordingCounts::count_with_reports(settings, inputs);
        Ok(DiagnosticsError::check(recorded, reports)?.0)
    }

    /// Counts the recordings, and reports unreadable ones, which count with a length of 0.
    ///
    /// For tools that report everything at once, such as the command `lipz`. All other programs call
    /// [`count`](RecordingCounts::count).
    #[must_use = "check the reports for missing recordings"]
    pub fn count_with_reports(settings: &Settings, inputs: &[Input]) -> (Option<RecordingCounts>, Vec<Report>) {
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
        let mut all = RecordingCounts { unused, ..RecordingCounts::default() };
        let found = threads::map(inputs, settings.options.get_threads(), |input| {
            of_clip(settings, &recordings, &record, input)
        });
        for (one, of_clip) in found {
            all.add(one);
            reports.extend(of_clip);
        }
        (Some(all), reports)
    }

    fn add(&mut self, other: RecordingCounts) {
        self.clips += other.clips;
        self.recordings += other.recordings;
        self.length_us = self.length_us.saturating_add(other.length_us);
        self.missing += other.missing;
        self.synced += other.synced;
        self.doubtful_words += other.doubtful_words;
    }
}

/// Returns the counts of a clip.
fn of_clip(
    settings: &Settings,
    recordings: &Recordings,
    record: &SyncRecord,
    input: &Input,
) -> (RecordingCounts, Vec<Report>) {
    let own = recordings.find(&input.key);
    let dubs = recordings.dubs(&input.key);
    let files: Vec<&Path> = own.into_iter().chain(dubs.into_iter().filter_map(|(_, path)| path)).collect();
    let mut found =
        RecordingCounts { clips: usize::from(own.is_some()), recordings: files.len(), ..RecordingCounts::default() };
    let mut reports = Vec::new();
    for path in files {
        match length_us(path) {
            Ok(length_us) => found.length_us = found.length_us.saturating_add(length_us),
            Err(report) => reports.push(report),
        }
    }
    let bytes = bytes_of(input).unwrap_or_default();
    if let Some(document) = lipz_file::parse(&bytes).document {
        let clip = ClipMouth::from_document(&document, &settings.options);
        found.missing = usize::from(is_unrecorded(settings, &clip, recordings, &input.key));
    }
    if let Content::File(lipz_file) = &input.content {
        // If there are several lines after a merge, the last one counts, as for emotions.
        let lines = record.lines_for(lipz_file);
        found.synced = usize::from(!lines.is_empty());
        found.doubtful_words =
            lines.iter().rev().find_map(|line| line.words.as_ref()).map_or(0, lipz_compiler::WordTimes::doubtful_count);
    }
    (found, reports)
}
