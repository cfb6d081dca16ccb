//! What `lipz stats --json` says about the recordings of a project.

use lipz_compiler::stats::Stats;
use lipz_sync::Recorded;
use serde::Serialize;

/// The statistics of a bank, with the recordings of the project that it is made of.
#[derive(Serialize)]
pub(super) struct WithRecorded<'s, 'd> {
    #[serde(flatten)]
    pub(super) stats: &'s Stats<'d>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) recorded: Option<Counts>,
}

/// [`Recorded`], element by element.
#[derive(Serialize)]
pub(super) struct Counts {
    clips: usize,
    recordings: usize,
    length_us: u64,
    missing: usize,
    unused: usize,
    synced: usize,
    doubtful_words: usize,
}

impl From<Recorded> for Counts {
    fn from(recorded: Recorded) -> Counts {
        let Recorded { clips, recordings, length_us, missing, unused, synced, doubtful_words, .. } = recorded;
        Counts { clips, recordings, length_us, missing, unused, synced, doubtful_words }
    }
}
