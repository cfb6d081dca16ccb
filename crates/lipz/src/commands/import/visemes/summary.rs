//! The summary at the end of an import.

use super::pending_clip::{ClipDestination, PendingClip};
use crate::console;
use lipz_interop::Format;
use std::collections::BTreeMap;
use std::path::Path;

/// The numbers of written files, by kind.
#[derive(Default)]
pub(super) struct WrittenCounts {
    files: usize,
    merged: usize,
}

impl WrittenCounts {
    pub(super) fn add(&mut self, place: ClipDestination) {
        self.files += usize::from(place != ClipDestination::Nowhere);
        self.merged += usize::from(place == ClipDestination::Merged);
    }

    pub(super) fn is_nothing(&self) -> bool {
        self.files == 0
    }
}

pub(super) fn summary(format: &Format, made: &[PendingClip], written: &WrittenCounts, folder: &Path) -> String {
    let mut maps: Vec<&str> = made.iter().map(|made| made.clip.map.as_str()).collect();
    maps.sort_unstable();
    maps.dedup();
    let lost: usize = made.iter().map(|made| made.clip.lost.len()).sum();
    let lost =
        if lost == 0 { String::new() } else { format!(", {} without a frame", console::counted(lost, "mouth shape")) };
    let merged = match written.merged {
        0 => String::new(),
        1 => "1 existing file: only its visemes are new\n".to_owned(),
        count => format!("{count} existing files: only their visemes are new\n"),
    };
    let (files, tables) = (console::counted(written.files, "file"), maps.join(", "));
    format!(
        "{files} imported from {} into {}, with the mapping table {tables}{lost}\n{merged}{}",
        format.name,
        console::path(folder),
        remarks(made)
    )
}

/// Returns how ambiguous files were interpreted, one kind per line.
fn remarks(made: &[PendingClip]) -> String {
    let mut files = BTreeMap::<&str, usize>::new();
    for remark in made.iter().flat_map(|made| &made.clip.remarks) {
        *files.entry(remark).or_default() += 1;
    }
    files.into_iter().map(|(remark, count)| format!("{}: {remark}\n", console::counted(count, "file"))).collect()
}
