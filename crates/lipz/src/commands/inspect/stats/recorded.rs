//! The recordings of a project in `lipz inspect --show stats --output-format json`.

use lipz_compiler::stats::Stats;
use lipz_sync::RecordingCounts;
use serde::Serialize;

/// The statistics of a bank, with the recordings of its project.
#[derive(Serialize)]
pub(super) struct StatsWithRecordings<'s, 'd> {
    #[serde(flatten)]
    pub(super) stats: &'s Stats<'d>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) recorded: Option<RecordingStats>,
}

/// [`RecordingCounts`], element by element.
#[derive(Serialize)]
pub(super) struct RecordingStats {
    clips: usize,
    recordings: usize,
    length_us: u64,
    missing: usize,
    unused: usize,
    synced: usize,
    doubtful_words: usize,
}

impl From<RecordingCounts> for RecordingStats {
    fn from(recorded: RecordingCounts) -> RecordingStats {
        let RecordingCounts { clips, recordings, length_us, missing, unused, synced, doubtful_words, .. } = recorded;
        RecordingStats { clips, recordings, length_us, missing, unused, synced, doubtful_words }
    }
}
