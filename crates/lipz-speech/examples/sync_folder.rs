//! Makes a mouth for each sound of a folder: `cargo run --release -p lipz-speech --example sync_folder -- FOLDER OUT
//! [LOCALE [MODEL…]]`. With `-` as LOCALE, without scripts. The script of `name.wav` is `name.txt`; its language is that of `name.json` (its element `lang`) or LOCALE. For
//! each, `OUT/name.json` has the frames, and the phones and words with their times in seconds: what scorers read.
//! A MODEL is a file that `lipz sync --train` made, or one that `lipz recogniser` made.

use lipz_speech::{
    AlignOptions, Aligner, Language, Model, Pronouncer, Recogniser, RecogniserError, RenderRules, Script, Sound,
    TrainedModel, render,
};
use lipz_types::{Fps, VisemeType};
use serde_json::{Value, json};
use std::error::Error;
use std::fs::{self, File};
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

/// What mouths are made with.
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
    let extension = path.extension().and_then(|extension| extension.to_str());
    let sound = Sound::read(File::open(path)?, extension)?;
    let aligner = Aligner::new(with.model, AlignOptions::default());
    let (script, alignment) = match (without_script, with.recogniser) {
        (true, None) => (Script::default(), aligner.listen(&sound)),
        (true, Some(recogniser)) => {
            let script = recogniser.hear(File::open(path)?, extension)?.script();
            (Script::default(), aligner.align(&sound, &script))
        }
        (false, _) => {
            let language = Language::from_locale(locale).ok_or("no such language")?;
            let script = Pronouncer::new(language).script(text.trim());
            let mut alignment = aligner.align(&sound, &script);
            if let Some(recogniser) = with.recogniser {
                let heard = recogniser.hear(File::open(path)?, extension)?;
                alignment.mismatches = heard.mismatches(&script, &alignment);
            }
            (script, alignment)
        }
    };
    let mouth = render(&alignment, VisemeType::Blair, Fps::whole(24), &RenderRules::default());
    let wall = started.elapsed().as_secs_f64();
    let seconds = |us: u64| us as f64 / 1e6;
    let phone = |phone: &lipz_speech::AlignedPhone| json!({ "p": phone.phone.name(), "s": seconds(phone.start_us), "e": seconds(phone.end_us), "fit": phone.fit });
    let word = |(word, times): (&lipz_speech::Word, &lipz_speech::AlignedWord)| json!({ "w": word.text, "s": seconds(times.start_us), "e": seconds(times.end_us), "c": times.confidence });
    let mismatch = |found: &lipz_speech::Mismatch| {
        let words = [found.words.start, found.words.end];
        json!({ "kind": format!("{:?}", found.kind), "w": words, "s": seconds(found.start_us), "e": seconds(found.end_us) })
    };
    Ok(json!({
        "visemes": mouth.frames, "viseme_type": "blair", "fps": 24, "phoneset": "arpa",
        "phones": alignment.phones.iter().map(phone).collect::<Vec<_>>(),
        "words": script.words.iter().zip(&alignment.words).map(word).collect::<Vec<_>>(),
        "mismatches": alignment.mismatches.iter().map(mismatch).collect::<Vec<_>>(), "wall": wall,
    }))
}
