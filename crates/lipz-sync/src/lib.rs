//! The recordings of a project and their Lipz files.
//!
//! A project with `[audio]` in its settings has a recording for each clip. [`Recordings`] finds them, [`FileFacts`]
//! contains the length and the hash of one, [`RecordingCounts`] counts them, and [`RecordedClip`] describes that of a
//! clip. [`check`] reports clips and recordings that do not match, and [`in_bank`] returns the data about recordings
//! for a bank. A [`SyncRun`] makes visemes from recordings, and a [`SyncRecord`] stores their sources. [`unapproved`]
//! lists recordings that are not confirmed for the current texts. [`PhoneTimeCache`] analyses a clip again to find the
//! times of its phones. [`train`](train()) trains a model on the voices of a project.
//!
//! This crate does not contain printing or exit codes, which are parts of `lipz`, nor phones, words and mouth shapes
//! (`lipz-speech`).

mod job;
mod lints;
mod record;
mod recordings;
pub mod shard;
mod threads;
mod train;

pub use job::{
    CodesOfPhones, GridExport, GridTiers, JOB_PARTS, Job, KeepReason, Original, PhoneTime, PhoneTimeCache, SyncOptions,
    SyncResults, SyncRun, WriteGuard, codes_of_phones, jobs_of_clips, jobs_of_recordings_with_reports, model_at,
    write_model,
};
pub use lints::{RecordingCounts, check};
pub use lipz_speech::{Recogniser, RecogniserError, TrainedModel};
pub use record::{
    DoubtfulWord, MouthHashes, OriginalHashes, RECORD_NAME, RecordLine, RecordedClip, RecordedText, SyncRecord,
    SyncState, UnapprovedRecording, dependencies, record_place, unapproved, unapproved_with_reports, word_times,
    word_times_of,
};
pub use recordings::{FactsCache, FileFacts, Recordings, content_hash, in_bank, is_recording};
pub use train::{TRAINING_ROUNDS, TrainingResult, train};

/// The example of the README, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
