//! The fixtures of `fixtures/interop`, in a folder for each format with its name.
#![allow(dead_code, reason = "each test program uses a part of this")]
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test stops at the first surprise")]

use lipz_interop::{Format, formats};
use std::fs;
use std::path::{Path, PathBuf};

/// Returns the fixtures of a format, sorted by name.
pub(crate) fn fixtures(format: &Format) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/interop").join(format.name);
    let entries = fs::read_dir(&folder);
    let entries = entries.unwrap_or_else(|_| panic!("no folder {}: put a file of the tool there", folder.display()));
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    files.retain(|file| file.extension().is_none_or(|extension| extension != "expected"));
    files.sort();
    files
}

/// Returns every format that can be imported, with each of its fixtures.
pub(crate) fn every_fixture() -> impl Iterator<Item = (&'static Format, PathBuf, Vec<u8>)> {
    let readable = formats::ALL.iter().filter(|format| format.read.is_some());
    readable.flat_map(|format| {
        fixtures(format).into_iter().map(move |file| {
            let bytes = fs::read(&file).unwrap();
            (format, file, bytes)
        })
    })
}
