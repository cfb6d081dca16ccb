//! Entries of clips that are missing from the project.

use crate::exchange::unreal::unreal_key;
use crate::exchange::{Entry, Words};
use lipz_diagnostics::{Code, Diagnostic, Span, escape, suggest};
use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};

/// The most diagnostics with a suggestion, because finding one takes long with many clips.
const SUGGESTIONS: usize = 20;

/// Gives entries the key of the only clip that they can mean, if their own is not among `keys`: without the namespace of
/// Unreal (`Dialogue,act1/mayor`), and regardless of case and of spaces around it, which spreadsheets change.
pub fn resolve_keys(entries: &mut [Entry], keys: &BTreeSet<&str>) {
    let mut folded: HashMap<String, Option<&str>> = HashMap::new();
    for key in keys {
        folded.entry(key.to_lowercase()).and_modify(|known| *known = None).or_insert(Some(key));
    }
    for entry in entries.iter_mut().filter(|entry| is_foreign(entry, keys)) {
        let own = entry.key.text.trim();
        let without_namespace = unreal_key(own).and_then(|key| keys.get(key.as_str()).copied());
        let meant = without_namespace.or_else(|| folded.get(&own.to_lowercase()).copied().flatten());
        if let Some(meant) = meant {
            entry.key = Words { text: meant.to_owned(), span: entry.key.span }.into();
        }
    }
}

/// Returns a diagnostic, with the number of the file, for each clip of the entries that is not in `keys`.
pub fn unknown_keys(entries: &[Entry], keys: &BTreeSet<&str>) -> Vec<(usize, Diagnostic)> {
    let mut told: HashSet<(usize, &str)> = HashSet::new();
    let unknown = entries.iter().filter(|entry| is_foreign(entry, keys));
    let (nameless, unknown): (Vec<&Entry>, Vec<&Entry>) = unknown.partition(|entry| entry.key.text.is_empty());
    let mut found = Vec::new();
    for entry in unknown.into_iter().filter(|entry| told.insert((entry.file, &entry.key.text))) {
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
    let mut first: BTreeMap<usize, (usize, Span)> = BTreeMap::new();
    for entry in nameless {
        first.entry(entry.file).or_insert((0, entry.key.span)).0 += 1;
    }
    for (file, (count, span)) in first {
        let message = match count {
            1 => "an entry has no key of a clip, and is not imported".to_owned(),
            _ => format!("{count} entries have no key of a clip, and are not imported"),
        };
        found.push((file, Diagnostic::at(Code::UnknownTextKey, span, message).help(BY_TEXT)));
    }
    found
}

/// Whether an entry belongs to no clip.
pub(super) fn is_foreign(entry: &Entry, keys: &BTreeSet<&str>) -> bool {
    !keys.contains(entry.key.text.as_str())
}

const BY_TEXT: &str = "if they translate texts of clips, import them with `--by-text`";
