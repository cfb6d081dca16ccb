//! Projects in shards: objects with all kinds of clips.

use lipz_bank::Recording;
use lipz_compiler::shard::{Shard, shard_of_key};
use lipz_compiler::{Compiler, Input, Options, Voices};
use proptest::prelude::*;
use std::collections::BTreeMap;
use std::fs;
use std::num::NonZero;
use std::path::{Path, PathBuf};

/// Writes the objects of `inputs` into a folder.
pub(crate) fn objects(compiler: &Compiler<'_>, inputs: &[Input], shards: u16, folder: &Path) -> Vec<PathBuf> {
    let count = NonZero::new(shards).unwrap();
    let voices = &compiler.options().get_voices();
    let of_shard = |shard: u16| {
        let is_own = |input: &&Input| shard_of_key(&input.key, voices, count) == shard;
        let own: Vec<Input> = inputs.iter().filter(is_own).cloned().collect();
        let object = compiler.object(&own, &Shard::new(shard, shards));
        let path = folder.join(format!("{shard}-of-{shards}.lipzobj"));
        fs::write(&path, object.bank.unwrap_or_else(|| panic!("{:?}", object.reports))).unwrap();
        path
    };
    (0..shards).map(of_shard).collect()
}

/// Returns the clips of the drama in the fixtures.
pub(crate) fn drama() -> Vec<Input> {
    super::files("drama").into_iter().map(|(key, bytes)| Input::from_bytes(key, bytes)).collect()
}

/// Returns options that affect the contents of a bank.
pub(crate) fn variants() -> [Options; 3] {
    let plain = Options::new().default_locale("en-us").unwrap();
    let some_locales = plain.clone().locales(["de-de", "fr-fr"]).unwrap().fallback("fr-fr", ["de-de"]).unwrap();
    [plain.clone(), plain.pseudo(true).strip(true), some_locales]
}

/// Generates a clip with texts in some locales, events, and curves.
fn file() -> impl Strategy<Value = String> {
    let text = "[a-zéß日{} ]{0,8}";
    let texts = proptest::collection::btree_map("(en-us|de-de|de-at|fr-fr|ja-jp|de-de-x-few|en-us-x-few)", text, 0..4);
    let events = proptest::option::of("(mara sees door|x|shout)");
    (texts, events, proptest::option::of("[MAEO]{1,9}"), 0..4_u8).prop_map(|(texts, events, visemes, extra)| {
        let mut elements = serde_json::Map::new();
        for (tag, text) in texts {
            // Braces must be in pairs.
            elements.insert(format!("text_{tag}"), text.replace(['{', '}'], "").into());
        }
        elements.extend(events.map(|events| ("events".to_owned(), events.into())));
        if let Some(visemes) = visemes {
            elements.insert("visemes".to_owned(), visemes.into());
            if extra == 1 {
                elements.insert("curves".to_owned(), serde_json::json!({ "jawOpen": "0:0.25" }));
            }
            if extra == 2 {
                elements.insert("fps".to_owned(), 23.976.into());
            }
        }
        if extra == 3 {
            elements.insert("note".to_owned(), serde_json::json!({ "kept": [1, 2] }));
        }
        serde_json::Value::Object(elements).to_string()
    })
}

/// Generates a project: clips, some of them with dubs or recordings, and its options.
pub(crate) fn project() -> impl Strategy<Value = (Options, Vec<Input>)> {
    let files = proptest::collection::btree_map("[a-d]{1,2}/line-[0-9]{1,3}", (file(), file(), 0..6_u8), 0..40);
    (files, any::<bool>(), any::<bool>()).prop_map(|(files, pseudo, chooses)| {
        let (mut inputs, mut recordings) = (BTreeMap::new(), Vec::new());
        for (key, (file, other, kind)) in files {
            if kind < 2 {
                recordings.push((key.clone(), Recording::new(u64::from(kind) * 7 + 1, 3)));
            }
            let dub = ["de/", "fr/"].get(usize::from(kind)).map(|voice| format!("{voice}{key}"));
            // Texts must not contradict those of the original.
            inputs.extend(dub.map(|key| (key, other.replace("text_", "note_"))));
            inputs.insert(key, file);
        }
        let inputs = inputs.into_iter().map(|(key, file)| Input::from_bytes(key, file)).collect();
        let voices = Voices::new("en-us").unwrap().dub("de-de", "de/{key}").unwrap().dub("fr-fr", "fr/{key}").unwrap();
        let options = Options::new()
            .default_locale("en-us")
            .unwrap()
            .fallback("ja-jp", ["fr-fr"])
            .unwrap()
            .fallback("fr-fr", ["de-de"])
            .unwrap();
        let options = options.pseudo(pseudo).voices(voices).recordings(recordings);
        (if chooses { options.locales(["de-at", "en-us", "ja-jp"]).unwrap() } else { options }, inputs)
    })
}
