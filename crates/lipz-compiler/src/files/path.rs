//! Paths in messages, and paths without redundant parts.

use std::path::{Component, MAIN_SEPARATOR, Path, PathBuf};

/// Returns the path without `.` parts, so that `voices`, `./voices` and `voices/` are equal. Links and `..` stay,
/// because only the file system can resolve them.
pub(crate) fn plain(path: &Path) -> PathBuf {
    let plain: PathBuf = path.components().filter(|part| *part != Component::CurDir).collect();
    if plain.as_os_str().is_empty() { PathBuf::from(".") } else { plain }
}

/// Returns a path for messages, with `/` on every system.
pub(crate) fn display(path: &Path) -> String {
    let path = path.to_string_lossy();
    if MAIN_SEPARATOR == '/' { path.into_owned() } else { path.replace(MAIN_SEPARATOR, "/") }
}
