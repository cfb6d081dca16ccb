//! Lip sync: makes the visemes of Lipz files from recordings.

pub(crate) mod grid;
mod grid_export;
mod jobs;
mod loaded;
mod model_file;
pub(crate) mod mouth;
mod options;
pub(crate) mod outcome;
mod phone_times;
mod phone_track;
mod progress;
mod reports;
mod results;
pub(crate) mod review_list;
pub(crate) mod run;
mod settings_hash;
mod soft_opening;
pub(crate) mod store;
mod sync_run;
mod target;
mod text_files;
pub(crate) mod work;
pub(crate) mod write;

pub use grid::{CodesOfPhones, codes_of_phones};
pub use grid_export::{GridExport, GridTiers};
pub use jobs::{Job, Original, jobs_of_clips, jobs_of_recordings_with_reports};
pub use model_file::{model_at, write_model};
pub use options::SyncOptions;
pub use outcome::KeepReason;
pub use phone_times::{PhoneTime, PhoneTimeCache};
pub use progress::JOB_PARTS;
pub use results::SyncResults;
pub use sync_run::SyncRun;
pub use write::WriteGuard;
