//! Entries of clips that were renamed after the export.

use super::keys::is_foreign;
use crate::exchange::clip_texts::trimmed;
use crate::exchange::model::joined;
use crate::exchange::{ClipTexts, Entry, Mark, Words};
use lipz_diagnostics::{Code, Diagnostic, Span, escape};
use lipz_file::locale::is_variant;
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// The most clips with one source text that are compared. A text that is this frequent identifies no clip.
const MOST_ALIKE: usize = 64;

/// Gives entries of renamed clips the new keys, and reports each of these clips, with the number of the file.
///
/// A clip counts as renamed if lipz has exported its entries, no clip has its key, and exactly one clip that the entries
/// do not name has the same source text and the translation of the export. `clips` are the keys and texts of all clips.
pub fn follow_renamed_clips(
    entries: &mut [Entry],
    keys: &BTreeSet<&str>,
    source_locale: &str,
    clips: &[(String, ClipTexts)],
) -> Vec<(usize, Diagnostic)> {
    let named: BTreeSet<&str> = entries.iter().map(|entry| entry.key.text.as_str()).collect();
    let index = SourceIndex::new(clips.iter().filter(|(key, _)| !named.contains(key.as_str())), source_locale);
    let mut by_key: BTreeMap<String, OldClip<'_>> = BTreeMap::new();
    // Variants follow their text.
    let is_text = |entry: &&Entry| entry.mark.is_some() && !is_variant(&entry.locale);
    for entry in entries.iter().filter(is_text).filter(|entry| is_foreign(entry, keys)) {
        let alike = index.alike(entry);
        by_key
            .entry(entry.key.text.clone())
            .and_modify(|old| {
                old.new.retain(|key| alike.contains(key));
                old.places.entry(entry.file).or_insert(entry.key.span);
            })
            .or_insert(OldClip { places: BTreeMap::from([(entry.file, entry.key.span)]), new: alike });
    }
    // If several old keys fit a clip, lipz cannot tell which one it had.
    let mut claims: HashMap<&str, usize> = HashMap::new();
    for old in by_key.values() {
        old.new.iter().for_each(|new| *claims.entry(new).or_default() += 1);
    }
    let mut renamed: HashMap<String, &str> = HashMap::new();
    let mut found = Vec::new();
    for (old, OldClip { places, new }) in by_key {
        let [new] = new.as_slice() else { continue };
        if claims.get(new).is_some_and(|count| *count > 1) {
            continue;
        }
        let (shown, now) = (escape::quoted(&old).to_string(), escape::quoted(new));
        let help = "its translations are imported; export the texts again, so that the file has the new key";
        found.extend(places.into_iter().map(|(file, span)| {
            let message = format!("the clip {shown} is now {now}, which has the same texts");
            (file, Diagnostic::at(Code::UnknownTextKey, span, message).help(help))
        }));
        renamed.insert(old, new);
    }
    for entry in entries.iter_mut().filter(|entry| entry.mark.is_some()) {
        if let Some(new) = renamed.get(&entry.key.text) {
            entry.key = Words { text: (*new).to_owned(), span: entry.key.span }.into();
        }
    }
    found
}

/// A clip that the project does not have, and the clips that it may be now.
struct OldClip<'c> {
    /// The first position of its key in each file.
    places: BTreeMap<usize, Span>,
    new: Vec<&'c str>,
}

/// The number of a segment, or `None` for the whole clip, and its source text.
type SourcePlace = (Option<usize>, String);

/// Clips by their source texts.
struct SourceIndex<'c> {
    by_source: HashMap<SourcePlace, Vec<&'c (String, ClipTexts)>>,
}

impl<'c> SourceIndex<'c> {
    fn new(clips: impl Iterator<Item = &'c (String, ClipTexts)>, source_locale: &str) -> SourceIndex<'c> {
        let mut by_source: HashMap<SourcePlace, Vec<_>> = HashMap::new();
        for clip in clips {
            let Some(segments) = clip.1.get(source_locale) else { continue };
            let parts = (1..).zip(segments).map(|(number, text)| (Some(number), text.clone()));
            for part in parts.chain([(None, joined(segments))]) {
                by_source.entry(part).or_default().push(clip);
            }
        }
        SourceIndex { by_source }
    }

    /// Returns the keys of the clips that have the source text of an entry, and its translation at the export.
    fn alike(&self, entry: &Entry) -> Vec<&'c str> {
        let Some(source) = &entry.source else { return Vec::new() };
        let place = (entry.segment, joined(&trimmed(&source.text)));
        let clips = self.by_source.get(&place).filter(|clips| clips.len() <= MOST_ALIKE);
        let has_translation = |clip: &&&(String, ClipTexts)| {
            let own = clip.1.get(&*entry.locale).map_or(&[][..], Vec::as_slice);
            let text = match entry.segment {
                Some(number) => own.get(number.saturating_sub(1)).cloned().unwrap_or_default(),
                None => joined(own),
            };
            Some(Mark::of(&text)) == entry.mark
        };
        clips.into_iter().flatten().filter(has_translation).map(|(key, _)| key.as_str()).collect()
    }
}
