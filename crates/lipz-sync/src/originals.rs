//! Of which clip another one is a dub, and where its Lipz file is.

use lipz_compiler::{Content, Input, Voices, key};
use std::borrow::Cow;
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// The clips among which originals are looked for: those of a run, and those whose files are beside a dub's. A run about one
/// file knows its original, too.
pub(crate) struct Originals<'a> {
    voices: &'a Voices,
    inputs: HashMap<&'a str, &'a Input>,
}

impl<'a> Originals<'a> {
    pub(crate) fn new(voices: &'a Voices, inputs: &'a [Input]) -> Originals<'a> {
        Originals { voices, inputs: inputs.iter().map(|input| (input.key.as_str(), input)).collect() }
    }

    /// Whether the run is about the clip with this key.
    pub(crate) fn has(&self, key: &str) -> bool {
        self.inputs.contains_key(key)
    }

    /// The original of the clip with this key and this file, if it is a dub.
    pub(crate) fn of(&self, dub: &str, lipz_file: &Path) -> Option<Cow<'a, Input>> {
        let on_disk = |key: &str| beside(lipz_file, dub, key).filter(|path| path.is_file());
        let key = self.voices.original_of(dub, |key| self.has(key) || on_disk(key).is_some())?;
        match self.inputs.get(key.as_str()) {
            Some(input) => Some(Cow::Borrowed(*input)),
            None => on_disk(&key).map(|path| Cow::Owned(Input { key, content: Content::File(path) })),
        }
    }
}

/// The Lipz file of the clip with the key `other`, under the root of the one that has this path and this key.
pub(crate) fn beside(path: &Path, key: &str, other: &str) -> Option<PathBuf> {
    let depth = key.split('/').count();
    let root = path.ancestors().nth(depth)?;
    Some(root.join(format!("{other}.{}", key::EXTENSION)))
}
