//! Entries of clips that were renamed after the export.

use super::keys::is_foreign;
use crate::exchange::clip_texts::trimmed;
use crate::exchange::model::joined;
use crate::exchange::{Entry, Words};
use lipz_diagnostics::{Code, Diagnostic, escape};
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// Gives entries of renamed clips the new keys, and reports each of these clips, with the number of the file.
///
/// A clip counts as renamed if lipz has exported the entry, no clip has its key, and its source text is that of exactly
/// one clip that the entries do not name. `sources` are the keys of clips and the source texts of their segments.
pub fn follow_renamed_clips(
    entries: &mut [Entry],
    keys: &BTreeSet<&str>,
    sources: &[(String, Vec<String>)],
) -> Vec<(usize, Diagnostic)> {
    let named: BTreeSet<&str> = entries.iter().map(|entry| entry.key.text.as_str()).collect();
    let mut by_source: HashMap<(Option<usize>, String), Option<&str>> = HashMap::new();
    for (key, segments) in sources.iter().filter(|(key, _)| !named.contains(key.as_str())) {
        let parts = (1..).zip(segments).map(|(number, text)| (Some(number), text.clone()));
        for part in parts.chain([(None, joined(segments))]) {
            by_source.entry(part).and_modify(|known| *known = None).or_insert(Some(key));
        }
    }
    let mut renamed: BTreeMap<(usize, String), (&str, lipz_diagnostics::Span)> = BTreeMap::new();
    for entry in entries.iter_mut().filter(|entry| entry.mark.is_some() && is_foreign(entry, keys)) {
        let Some(source) = &entry.source else { continue };
        let place = (entry.segment, joined(&trimmed(&source.text)));
        let Some(new) = by_source.get(&place).copied().flatten() else { continue };
        renamed.entry((entry.file, entry.key.text.clone())).or_insert((new, entry.key.span));
        entry.key = Words { text: new.to_owned(), span: entry.key.span }.into();
    }
    let report = |((file, old), (new, span)): ((usize, String), (&str, lipz_diagnostics::Span))| {
        let (old, new) = (escape::quoted(&old), escape::quoted(new));
        let message = format!("the clip {old} is now {new}, which has the same source text");
        let help = "its translations are imported; export the texts again, so that the file has the new key";
        (file, Diagnostic::at(Code::UnknownTextKey, span, message).help(help))
    };
    renamed.into_iter().map(report).collect()
}
