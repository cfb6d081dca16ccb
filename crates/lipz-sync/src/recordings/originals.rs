//! The originals of dubs, and their Lipz files.

use lipz_compiler::{Content, Input, Voices, key};
use std::borrow::Cow;
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// The clips that may be originals: those of a run, and those whose files are next to a dub's, so that a run over one
/// file also finds its original.
pub(crate) struct Originals<'a> {
    voices: &'a Voices,
    inputs: HashMap<&'a str, &'a Input>,
}

impl<'a> Originals<'a> {
    pub(crate) fn new(voices: &'a Voices, inputs: &'a [Input]) -> Originals<'a> {
        Originals { voices, inputs: inputs.iter().map(|input| (input.key.as_str(), input)).collect() }
    }

    /// Whether the run includes the clip with this key.
    pub(crate) fn has(&self, key: &str) -> bool {
        self.inputs.contains_key(key)
    }

    /// Returns the original of the clip with this key and this file, if it is a dub.
    pub(crate) fn of(&self, dub: &str, lipz_file: &Path) -> Option<Cow<'a, Input>> {
        let on_disk = |key: &str| beside(lipz_file, dub, key).filter(|path| path.is_file());
        let key = self.voices.original_of(dub, |key| self.has(key) || on_disk(key).is_some())?;
        match self.inputs.get(key.as_str()) {
            Some(input) => Some(Cow::Borrowed(*input)),
            None => on_disk(&key).map(|path| Cow::Owned(Input { key, content: Content::File(path) })),
        }
    }
}

/// Returns the Lipz file of the clip with the key `other`, under the same root as the one with this path and key.
pub(crate) fn beside(path: &Path, key: &str, other: &str) -> Option<PathBuf> {
    let depth = key.split('/').count();
    // In a folder below the root, a path has fewer parts than its key.
    let below = if path.is_relative() { (depth + 1).saturating_sub(path.ancestors().count()) } else { 0 };
    let above: PathBuf = std::iter::repeat_n("..", below).collect();
    let root = above.join(path.ancestors().nth(depth - below)?);
    Some(root.join(format!("{other}.{}", key::EXTENSION)))
}
