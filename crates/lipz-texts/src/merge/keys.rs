//! Entries of clips that are missing from the project.

use crate::exchange::Entry;
use lipz_diagnostics::{Code, Diagnostic, escape, suggest};
use std::collections::{BTreeSet, HashSet};

/// The most diagnostics with a suggestion, because finding one takes long with many clips.
const SUGGESTIONS: usize = 20;

/// Returns a diagnostic, with the number of the file, for each clip of the entries that is not in `keys`.
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
            Some(near) => diagnostic
                .help(format!("correct the key if the clip was renamed; did you mean {}?", escape::quoted(near))),
            None => {
                diagnostic.help("correct the key, the path of the Lipz file, if the clip was renamed after the export")
            }
        };
        found.push((entry.file, diagnostic));
    }
    found
}
