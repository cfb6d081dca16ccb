//! Lip sync on several machines: the mouths of a shard in a file of their own, and such files merged into the Lipz files.

mod merge;
mod mouths;
mod step;

pub use merge::merge;
pub use mouths::Mouths;
pub use step::{beside, mouths};

use crate::SyncRecord;
use lipz_compiler::shard::ContentHash;
use lipz_compiler::{Content, Input};
use std::path::Path;

/// The hash of what the record says of an input, if it says something.
pub fn record_hash(record: &SyncRecord, input: &Input) -> Option<ContentHash> {
    match &input.content {
        Content::File(lipz_file) => hash_of(record, lipz_file),
        Content::Bytes { .. } => None,
    }
}

/// The hash of what the record says of the mouth of a Lipz file.
fn hash_of(record: &SyncRecord, lipz_file: &Path) -> Option<ContentHash> {
    hash(record.lines_for(lipz_file).iter().map(|line| line.written("")).collect())
}

/// The same with what it says of recordings, which makes no other bank, but other lines of a mouth.
fn hash_for_sync(record: &SyncRecord, lipz_file: &Path) -> Option<ContentHash> {
    let lines = record.lines_for(lipz_file).iter().map(|line| line.written(""));
    hash(lines.chain(record.all_spoken(lipz_file).iter().map(|spoken| spoken.written(""))).collect())
}

fn hash(mut lines: Vec<String>) -> Option<ContentHash> {
    lines.sort_unstable();
    (!lines.is_empty()).then(|| ContentHash::of(lines.join("\n").as_bytes()))
}
