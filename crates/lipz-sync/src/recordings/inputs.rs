//! The Lipz files of inputs.

use lipz_compiler::{Content, Input};
use std::borrow::Cow;
use std::fs;
use std::path::PathBuf;

/// Returns the file of an input, even if its text is not saved, because its record still applies.
pub(crate) fn path_of(input: &Input) -> Option<PathBuf> {
    match &input.content {
        Content::File(path) => Some(path.clone()),
        Content::Bytes { name, .. } => Some(PathBuf::from(name)).filter(|path| path.is_file()),
    }
}

/// Returns the bytes of a Lipz file; `None` if it cannot be read.
pub(crate) fn bytes_of(input: &Input) -> Option<Cow<'_, [u8]>> {
    match &input.content {
        Content::Bytes { bytes, .. } => Some(Cow::Borrowed(bytes.as_slice())),
        Content::File(path) => fs::read(path).ok().map(Cow::Owned),
    }
}
