//! The files of a dialogue in the cases.

use lipz_bank::Dialogue;
use lipz_bank::files::{DialogueFile, SetIndex};
use std::fs;
use std::path::{Path, PathBuf};

/// Returns the files in `NAME.list` in their order, with the banks of a set after its index; without a list,
/// `NAME.lipzbank` alone.
pub(super) fn of_bank(folder: &Path, name: &str) -> Vec<PathBuf> {
    match fs::read_to_string(folder.join(format!("{name}.list"))) {
        Ok(list) => list.lines().map(|file| folder.join(file)).collect(),
        Err(_) => vec![folder.join(format!("{name}.lipzbank"))],
    }
}

/// Opens the files, for as long as the test runs.
pub(super) fn open(paths: &[PathBuf]) -> &'static Dialogue<'static> {
    let mut contents: Vec<&'static [u8]> = Vec::new();
    for path in paths {
        let bytes: &[u8] = fs::read(path).expect("a file").leak();
        contents.push(bytes);
        let index = SetIndex::open(bytes).ok();
        for bank in index.iter().flat_map(SetIndex::banks) {
            contents.push(fs::read(path.with_file_name(bank.file_name)).expect("a bank of the set").leak());
        }
    }
    let files = vec![DialogueFile::ABSENT; contents.len()].leak();
    Box::leak(Box::new(Dialogue::open(files, contents).expect("they fit")))
}
