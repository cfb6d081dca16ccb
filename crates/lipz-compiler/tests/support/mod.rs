//! Fixtures for the tests of this crate.
#![allow(dead_code, reason = "each test program uses a part of this")]
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test stops at the first surprise")]

#[cfg(feature = "shards")]
pub(crate) mod shards;

use lipz_compiler::{Content, discover};
use std::path::{Path, PathBuf};

/// Returns a folder of the repository's fixtures.
pub(crate) fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures").join(name)
}

/// Returns keys and contents of the Lipz files in a folder of the fixtures.
pub(crate) fn files(name: &str) -> Vec<(String, Vec<u8>)> {
    let inputs = discover(&[folder(name)], None).unwrap();
    inputs
        .into_iter()
        .map(|input| match input.content {
            Content::File(path) => (input.key, std::fs::read(path).unwrap()),
            Content::Bytes { bytes, .. } => (input.key, bytes),
        })
        .collect()
}
