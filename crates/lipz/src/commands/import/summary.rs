//! What is said at the end of an import.

use super::made::{Made, Place};
use crate::console;
use lipz_interop::Format;
use std::collections::BTreeMap;
use std::path::Path;

/// How many files were written, and how.
#[derive(Default)]
pub(super) struct Written {
    files: usize,
    merged: usize,
}

impl Written {
    pub(super) fn add(&mut self, place: Place) {
        self.files += usize::from(place != Place::Nowhere);
        self.merged += usize::from(place == Place::Merged);
    }

    pub(super) fn is_nothing(&self) -> bool {
        self.files == 0
    }
}

pub(super) fn summary(format: &Format, made: &[Made], written: &Written, folder: &Path) -> String {
    let mut maps: Vec<&str> = made.iter().map(|made| made.clip.map.as_str()).collect();
    maps.sort_unstable();
    maps.dedup();
    let lost: usize = made.iter().map(|made| made.clip.lost.len()).sum();
    let lost =
        if lost == 0 { String::new() } else { format!(", {} without a frame", console::counted(lost, "mouth shape")) };
    let merged = match written.merged {
        0 => String::new(),
        1 => "1 file existed: only its mouth is new\n".to_owned(),
        count => format!("{count} files existed: only their mouths are new\n"),
    };
    let (files, tables) = (console::counted(written.files, "file"), maps.join(", "));
    format!(
        "{files} imported from {} into {}, by the mapping table {tables}{lost}\n{merged}{}",
        format.name,
        console::path(folder),
        remarks(made)
    )
}

/// How the files were read where there was a choice, one kind a line.
fn remarks(made: &[Made]) -> String {
    let mut files = BTreeMap::<&str, usize>::new();
    for remark in made.iter().flat_map(|made| &made.clip.remarks) {
        *files.entry(remark).or_default() += 1;
    }
    files.into_iter().map(|(remark, count)| format!("{}: {remark}\n", console::counted(count, "file"))).collect()
}
