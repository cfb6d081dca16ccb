//! Paths in the form of keys and messages.

use lipz_compiler::{Content, Input};
use std::path::Path;

/// Returns a relative path with `/`, if it is Unicode.
pub(crate) fn slashed(path: &Path) -> Option<String> {
    let parts: Option<Vec<&str>> = path.iter().map(|part| part.to_str()).collect();
    Some(parts?.join("/"))
}

/// Returns a path for messages, with `/` on every system.
pub(crate) fn shown(path: &Path) -> String {
    Input { key: String::new(), content: Content::File(path.to_owned()) }.name()
}
