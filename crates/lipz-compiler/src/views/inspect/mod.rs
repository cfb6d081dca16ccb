//! The contents of a bank: a summary, its clips, and one of them in full or as a [`Timeline`].
//!
//! All types implement `serde::Serialize` with the feature `json`.

mod clip;
mod summary;
mod timeline;

pub use clip::{ClipDetails, ClipSummary, SegmentDetails, SegmentEvent, SegmentText};
pub use summary::{BankSummary, LayerSummary, LocaleSummary, VoiceSummary};
pub use timeline::{Timeline, short_fps, short_recording};
