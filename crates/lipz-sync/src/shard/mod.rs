//! Lip sync on several machines: the visemes of a shard in a separate file, and merging of these files into the Lipz
//! files.

mod merge;
mod mouths;
mod step;

pub use merge::merge;
pub use mouths::Mouths;
pub use step::{beside, mouths};

use crate::record::SyncRecord;
use lipz_compiler::shard::ContentHash;
use lipz_compiler::{Content, Input};
use std::path::Path;

/// Returns the hash of an input's lines in the record, if it has any.
pub fn record_hash(record: &SyncRecord, input: &Input) -> Option<ContentHash> {
    match &input.content {
        Content::File(lipz_file) => hash_of(record, lipz_file),
        Content::Bytes { .. } => None,
    }
}

/// Returns the hash of the lines about the visemes of a Lipz file.
fn hash_of(record: &SyncRecord, lipz_file: &Path) -> Option<ContentHash> {
    hash(record.lines_for(lipz_file).iter().map(|line| line.written("")).collect())
}

/// Returns the same, including the lines about recordings, which do not affect the bank, but do affect later lines.
fn hash_for_sync(record: &SyncRecord, lipz_file: &Path) -> Option<ContentHash> {
    let lines = record.lines_for(lipz_file).iter().map(|line| line.written(""));
    hash(lines.chain(record.all_spoken(lipz_file).iter().map(|spoken| spoken.written(""))).collect())
}

fn hash(mut lines: Vec<String>) -> Option<ContentHash> {
    lines.sort_unstable();
    (!lines.is_empty()).then(|| ContentHash::of(lines.join("\n").as_bytes()))
}
