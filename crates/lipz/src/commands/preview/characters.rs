//! The characters of a clip: those in its events, the speakers in its texts, and those whose names are in its key.

use super::version::Version;
use crate::shared::characters::{Spellings, in_events, in_key};
use lipz_bank::Dialogue;
use lipz_compiler::Documents;
use lipz_file::{Value, locale::text_name, text};
use std::collections::{BTreeMap, BTreeSet};

/// The characters of clips, by clip key.
pub(super) type Characters = BTreeMap<String, BTreeSet<String>>;

/// Returns the characters of each clip that has any, by clip key.
pub(super) fn of_clips(version: &Version, bank: &Dialogue<'_>) -> Characters {
    let mut found = Characters::new();
    let mut spellings = Spellings::default();
    for name in version.options.get_known_names().get_characters().into_iter().flatten() {
        spellings.of(name);
    }
    for clip in bank.clips() {
        let named = in_events(&clip).into_iter().map(|name| spellings.of(name)).collect();
        found.insert(clip.key().to_owned(), named);
    }
    for (key, name) in speakers(&version.bank, bank) {
        found.entry(key).or_default().insert(spellings.of(&name));
    }
    let of_bank = bank.clips().map(|clip| clip.key());
    let keys: BTreeSet<&str> = version.files.keys().map(String::as_str).chain(of_bank).collect();
    let names = spellings.by_words();
    for key in keys {
        found.entry(key.to_owned()).or_default().extend(in_key(key, &names));
    }
    // A dub has the speaker of its original.
    for (clip, original) in bank.clips().filter_map(|clip| Some((clip, clip.original()?))) {
        let of_original = found.get(original.key()).cloned().unwrap_or_default();
        found.entry(clip.key().to_owned()).or_default().extend(of_original);
    }
    found
}

/// Returns a clip key and a name for each `{speaker: …}` in the texts. A bank without files has none.
fn speakers(bytes: &[u8], bank: &Dialogue<'_>) -> Vec<(String, String)> {
    // Most projects do not name speakers this way. Then the bank need not be decompiled.
    if !text::may_name_speakers(bytes) {
        return Vec::new();
    }
    let Ok(documents) = Documents::from_dialogue(bank) else { return Vec::new() };
    let of_document = |(key, document): (&str, lipz_file::Document<'_>)| {
        let texts = document.elements.iter().filter(|element| text_name(&element.name.text).is_some());
        let strings = texts.filter_map(|element| match &element.value {
            Value::String(string) => Some(&string.text),
            _ => None,
        });
        let names = strings.flat_map(|string| text::speakers(string).map(str::to_owned).collect::<Vec<_>>());
        let names = names.filter(|name| !name.is_empty());
        names.map(|name| (key.to_owned(), name)).collect::<Vec<_>>()
    };
    documents.iter().filter_map(Result::ok).flat_map(of_document).collect()
}
