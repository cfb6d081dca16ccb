//! `lipz sync --train`: trains a model on the project's own voices.

use crate::console::{counted, grouped};
use crate::reporter::{Abort, Reporter};
use crate::{console, interrupt};
use lipz_compiler::settings::Settings;
use lipz_sync::{Job, SyncOptions, TRAINING_ROUNDS, TrainedModel, model_at, train as learn, write_model};
use std::path::{Path, PathBuf};

/// Returns the path of the new model, and removes it from the settings so that the old model is not read.
pub(super) fn place(settings: &mut Settings, reporter: &mut Reporter) -> Result<PathBuf, Abort> {
    settings.sync.model.take().ok_or_else(|| {
        let tip = "set `model` in [sync], or pass `--config sync.model=FILE`";
        reporter.usage("the path of the model is not set", tip)
    })
}

/// Trains a model on the recordings of these jobs, writes it to `place` and uses it. Returns a message about it.
pub(super) fn train(
    jobs: &[Job],
    options: &mut SyncOptions,
    place: &Path,
    quiet: bool,
    reporter: &mut Reporter,
) -> Result<String, Abort> {
    if options.locale.is_none() {
        let tip = "set `default-locale` in lipz.toml, or pass `--config audio.locale=en-us`";
        return Err(reporter.usage("the locale of the recordings is not set", tip));
    }
    let known = model_at(place).map_err(|report| reporter.fail(report))?;
    let bar = console::progress_bar(jobs.len() * TRAINING_ROUNDS, quiet);
    let progress = || bar.inc(1);
    let trained = learn(jobs, options, known.as_ref(), &progress);
    bar.finish_and_clear();
    let shown = console::path(place);
    match trained.map_err(|report| reporter.fail(report))? {
        Some(trained) => {
            let model =
                interrupt::whole(|| write_model(place, &trained.model)).map_err(|report| reporter.fail(report))?;
            let left_out = match trained.left_out {
                0 => String::new(),
                count => format!(" ({} left out, because they do not match their texts)", grouped(count)),
            };
            let told = format!("model trained on {}{left_out}, in {shown}\n", of(&model));
            options.set_model(model);
            Ok(told)
        }
        None => {
            let told = known.as_ref().map(|model| format!("the model in {shown} is up to date: {}\n", of(model)));
            known.into_iter().for_each(|model| options.set_model(model));
            Ok(told.unwrap_or_default())
        }
    }
}

/// Describes the training data of a model.
fn of(model: &TrainedModel) -> String {
    let minutes = f64::from(model.speech_s) / 60.0;
    format!(
        "{:.1} minutes of {} in {}",
        minutes,
        model.language.name(),
        counted(model.recordings as usize, "recording")
    )
}
