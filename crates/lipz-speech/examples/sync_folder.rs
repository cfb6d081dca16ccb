//! Makes a lip-sync track for each recording in a folder: `cargo run --release -p lipz-speech --example sync_folder --
//! FOLDER OUT [LOCALE [MODEL…]]`. With `-` as LOCALE, it does not use scripts. The script of `name.wav` is `name.txt`.
//! Its language is the element `lang` of `name.json`, or LOCALE. `OUT/name.json` gets the frames, and the phones and
//! words with their times in seconds, for scoring tools. A MODEL is a file made by `lipz sync --train` or `lipz import
//! recogniser`.

use lipz_speech::{Language, LipSync, Model, Recogniser, RecogniserError, TrainedModel};
use serde_json::{Value, json};
use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let (folder, out, locale, models) = match &arguments[..] {
        [folder, out] => (folder, out, "en", &[][..]),
        [folder, out, locale, models @ ..] => (folder, out, locale.as_str(), models),
        _ => return Err("usage: sync_folder FOLDER OUT [LOCALE [MODEL…]]".into()),
    };
    let (mut trained, mut recogniser) = (None, None);
    for model in models {
        let bytes = fs::read(model)?;
        match Recogniser::from_bytes(&bytes) {
            Err(RecogniserError::OtherFile) => trained = Some(TrainedModel::from_bytes(&bytes)?.model),
            read => recogniser = Some(read?),
        }
    }
    let with = With { locale, model: trained.as_ref().unwrap_or(Model::english()), recogniser: recogniser.as_ref() };
    fs::create_dir_all(out)?;
    let mut sounds: Vec<PathBuf> = fs::read_dir(folder)?.filter_map(|entry| Some(entry.ok()?.path())).collect();
    sounds.retain(|path| path.with_extension("txt").exists() && path.extension().is_some_and(|name| name != "txt"));
    sounds.retain(|path| path.extension().is_some_and(|name| name != "json"));
    sounds.sort();
    for path in sounds {
        let prediction = sync(&path, &with)?;
        let name = path.file_stem().unwrap_or_default();
        fs::write(Path::new(out).join(name).with_extension("json"), prediction.to_string())?;
    }
    Ok(())
}

/// The settings for all recordings.
struct With<'w> {
    locale: &'w str,
    model: &'w Model,
    recogniser: Option<&'w Recogniser>,
}

fn sync(path: &Path, with: &With<'_>) -> Result<Value, Box<dyn Error>> {
    let text = fs::read_to_string(path.with_extension("txt"))?;
    let facts = fs::read(path.with_extension("json")).unwrap_or_default();
    let facts: Value = serde_json::from_slice(&facts).unwrap_or_default();
    let without_script = with.locale == "-";
    let locale = facts["lang"].as_str().unwrap_or(with.locale);
    let started = Instant::now();
    // Without a script, the language has no effect.
    let language = if without_script { Some(Language::ENGLISH) } else { Language::from_locale(locale) };
    let mut lip_sync = LipSync::new(language.ok_or("no such language")?).model(with.model);
    if let Some(recogniser) = with.recogniser {
        lip_sync = lip_sync.recogniser(recogniser);
    }
    let line = lip_sync.file(path, if without_script { "" } else { text.trim() })?;
    let wall = started.elapsed().as_secs_f64();
    let seconds = |us: u64| us as f64 / 1e6;
    let phone = |phone: &lipz_speech::AlignedPhone| json!({ "p": phone.phone.name(), "s": seconds(phone.start_us), "e": seconds(phone.end_us), "fit": phone.fit });
    let word = |(word, times): (&lipz_speech::Word, &lipz_speech::AlignedWord)| json!({ "w": word.text, "s": seconds(times.start_us), "e": seconds(times.end_us), "c": times.confidence });
    let mismatch = |found: &lipz_speech::Mismatch| {
        let words = [found.words.start, found.words.end];
        json!({ "kind": format!("{:?}", found.kind), "w": words, "s": seconds(found.start_us), "e": seconds(found.end_us) })
    };
    Ok(json!({
        "visemes": line.mouth.frames, "viseme_type": "blair", "fps": 24, "phoneset": "arpa",
        "phones": line.alignment.phones.iter().map(phone).collect::<Vec<_>>(),
        "words": line.words().filter(|_| !without_script).map(word).collect::<Vec<_>>(),
        "mismatches": line.alignment.mismatches.iter().map(mismatch).collect::<Vec<_>>(), "wall": wall,
    }))
}
