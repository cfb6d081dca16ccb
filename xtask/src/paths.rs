//! Paths: the workspace, and a folder for temporary files.

use crate::Failure;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// Returns the root of the workspace, which cargo passes in `cargo run` and `cargo test`.
pub(crate) fn workspace_root() -> PathBuf {
    match std::env::var_os("CARGO_MANIFEST_DIR").map(PathBuf::from) {
        Some(manifest) => manifest.parent().map_or(manifest.clone(), Path::to_owned),
        None => PathBuf::from("."),
    }
}

/// Returns the folder of cargo's build output.
pub(crate) fn target_folder() -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| workspace_root().join("target"), PathBuf::from)
}

/// Returns a new folder below `target`, removed when dropped. The system's folder for temporary files is often in
/// memory: too small for 100,000 files, and not suitable to measure a disk.
pub(crate) fn temporary_folder() -> Result<TempDir, Failure> {
    let parent = target_folder().join("xtask");
    std::fs::create_dir_all(&parent)
        .and_then(|()| tempfile::tempdir_in(&parent))
        .map_err(|error| format!("no temporary folder in `{}`: {error}", parent.display()))
}
