//! The recordings of a project and its Lipz files.
//!
//! A project with `[audio]` in its settings has a recording for each clip. [`Recordings`] finds them, [`Facts`] is what
//! is known of one: its length and the hash of its file, [`Recorded`] counts them, [`RecordedClip`] is
//! that of a clip. [`check`] reports what does not belong together, and
//! [`in_bank`] is what a bank says about recordings. A [`SyncRun`] makes mouths of recordings, and a [`SyncRecord`]
//! remembers what each was made from; [`unaccepted`] are recordings of which nobody knows that they say what is written now.
//! [`KnownPhones`] hears once more when each sound of a clip is said. [`train`] learns a
//! model of the voices of a project.
//!
//! What is not here: printing, exit codes (`lipz`); phones, words and mouth shapes (`lipz-speech`).

mod accept;
mod clip;
mod condition;
mod facts;
mod heard;
mod in_bank;
mod known;
mod lints;
mod originals;
mod places;
mod recorded;
mod recorded_clip;
mod recordings;
pub mod shard;
mod spoken_now;
mod sync;
mod threads;
mod words;

pub use accept::{Unaccepted, unaccepted, unaccepted_with_reports};
pub use facts::{Facts, content_hash};
pub use in_bank::in_bank;
pub use known::KnownRecordings;
pub use lints::check;
pub use lipz_speech::{Recogniser, RecogniserError, TrainedModel};
pub use recorded::Recorded;
pub use recorded_clip::{RecordedClip, SyncState};
pub use recordings::{Recordings, dependencies, is_recording};
pub use sync::{
    CodesOfPhones, DoubtfulWord, JOB_PARTS, Job, Kept, KnownPhones, Line, Made, Original, OriginalThen, PhoneTime,
    RECORD_NAME, Said, SaidTiers, Spoken, SyncOptions, SyncRecord, SyncRun, Synced, TRAINING_ROUNDS, Trained, Whole,
    codes_of_phones, jobs_of_clips, jobs_of_recordings_with_reports, model_at, record_place, train, write_model,
};
pub(crate) use sync::{spoken_string, spoken_text};
pub use words::{word_times, word_times_of};

/// The example of the README, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
