//! Entries of clips that the project does not have.

use crate::Entry;
use lipz_diagnostics::{Code, Diagnostic, escape, suggest};
use std::collections::{BTreeSet, HashSet};

/// Diagnostics that say what was probably meant: finding that out takes long with many clips.
const SUGGESTIONS: usize = 20;

/// A diagnostic for each clip of the entries that is not among `keys`, with the number of the file.
pub fn unknown_keys(entries: &[Entry], keys: &BTreeSet<&str>) -> Vec<(usize, Diagnostic)> {
    let mut told: HashSet<(usize, &str)> = HashSet::new();
    let unknown = entries.iter().filter(|entry| !keys.contains(entry.key.text.as_str()));
    let mut found = Vec::new();
    for entry in unknown.filter(|entry| told.insert((entry.file, &entry.key.text))) {
        let message = format!("the project has no clip {}", escape::quoted(&entry.key.text));
        let mut diagnostic = Diagnostic::at(Code::UnknownTextKey, entry.key.span, message);
        let near =
            (found.len() < SUGGESTIONS).then(|| suggest::nearest(&entry.key.text, keys.iter().copied())).flatten();
        diagnostic = match near {
            Some(near) => diagnostic.help(format!("was it renamed? did you mean {}?", escape::quoted(near))),
            None => diagnostic.help("was it renamed or deleted after the export? its key is the path of its Lipz file"),
        };
        found.push((entry.file, diagnostic));
    }
    found
}
