//! Trains a model on the voice in a folder: `cargo run --release -p lipz-speech --example train_folder -- FOLDER LOCALE
//! MODEL`. The script of `name.wav` is `name.txt`. `sync_folder` reads MODEL; projects use `lipz sync --train`.

use lipz_speech::{Language, Model, Observations, Pronouncer, Sound, TrainedModel, Training};
use std::error::Error;
use std::fs::{self, File};
use std::path::PathBuf;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [folder, locale, model] = &arguments[..] else {
        return Err("usage: train_folder FOLDER LOCALE MODEL".into());
    };
    let language = Language::from_locale(locale).ok_or("no such language")?;
    let pronouncer = Pronouncer::new(language);
    let mut sounds: Vec<PathBuf> = fs::read_dir(folder)?.filter_map(|entry| Some(entry.ok()?.path())).collect();
    sounds.retain(|path| path.extension().is_some_and(|extension| extension == "wav"));
    sounds.sort();
    let lesson = |path: PathBuf| -> Result<_, Box<dyn Error>> {
        let text = fs::read_to_string(path.with_extension("txt"))?;
        Ok((Sound::read(File::open(&path)?, Some("wav"))?, pronouncer.script(text.trim())))
    };
    let lessons = sounds.into_iter().map(lesson).collect::<Result<Vec<_>, _>>()?;
    let mut training = Training::new(Model::english());
    let mut last = Observations::default();
    for _ in 0..Training::ROUNDS {
        last = Observations::default();
        lessons.iter().for_each(|(sound, script)| training.observe(sound, script, &mut last));
        training.learn(&last);
    }
    let (speech_s, used) = (u32::try_from(last.speech_us() / 1_000_000)?, u32::try_from(last.used())?);
    println!("{locale}: {speech_s} s of speech in {used} recordings, {} left out", last.left_out());
    fs::write(model, TrainedModel::new(training.model().clone(), language, 0, speech_s, used).to_bytes())?;
    Ok(())
}
