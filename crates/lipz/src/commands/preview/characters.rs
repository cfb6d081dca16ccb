//! Who is in a clip: whom its events name, who speaks by its texts, and whose name is in its key.

use super::version::Version;
use crate::shared::characters::in_events;
use lipz_bank::Bank;
use lipz_compiler::Documents;
use lipz_file::{Value, locale::text_name, text};
use std::collections::{BTreeMap, BTreeSet};

/// The characters of each clip that has some, by its key.
pub(super) fn of_clips(version: &Version, bank: &Bank<'_>) -> BTreeMap<String, BTreeSet<String>> {
    let mut found: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    let mut spellings = Spellings::default();
    for name in version.options.known_names.characters.iter().flatten() {
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
    for key in keys {
        let of_key = parts(key).filter_map(|part| spellings.known(part));
        found.entry(key.to_owned()).or_default().extend(of_key);
    }
    // A dub is spoken by whoever speaks its original.
    for (clip, original) in bank.clips().filter_map(|clip| Some((clip, clip.original()?))) {
        let of_original = found.get(original.key()).cloned().unwrap_or_default();
        found.entry(clip.key().to_owned()).or_default().extend(of_original);
    }
    found
}

/// The first spelling of each name that was seen: `Mara` of a text is `mara` of the events.
#[derive(Default)]
struct Spellings(BTreeMap<String, String>);

impl Spellings {
    fn of(&mut self, name: &str) -> String {
        self.0.entry(name.to_lowercase()).or_insert_with(|| name.to_owned()).clone()
    }

    fn known(&self, name: &str) -> Option<String> {
        self.0.get(&name.to_lowercase()).cloned()
    }
}

/// The key of a clip and a name, for each `{speaker: …}` in its texts. A bank without files has none.
fn speakers(bytes: &[u8], bank: &Bank<'_>) -> Vec<(String, String)> {
    // Most projects name nobody in this way, and then no file is made of the bank.
    if !text::may_name_speakers(bytes) {
        return Vec::new();
    }
    let Ok(documents) = Documents::from_bank(bank) else { return Vec::new() };
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

/// The words of a key: `act1`, `mara`, `good` and `evening` of `act1/mara-good-evening`.
fn parts(key: &str) -> impl Iterator<Item = &str> {
    key.split(|c: char| !c.is_alphanumeric()).filter(|part| !part.is_empty())
}
