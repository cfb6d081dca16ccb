//! `lipz sync --train`: a model of the project's own voices.

use crate::console::{counted, grouped};
use crate::reporter::{Abort, Reporter};
use crate::{console, interrupt};
use lipz_compiler::settings::Settings;
use lipz_sync::{Job, SyncOptions, TRAINING_ROUNDS, TrainedModel, model_at, train as learn, write_model};
use std::path::{Path, PathBuf};

/// Where the model is written; the settings then name none, so that nobody reads the old one.
pub(super) fn place(settings: &mut Settings, reporter: &mut Reporter) -> Result<PathBuf, Abort> {
    settings.sync.model.take().ok_or_else(|| {
        let tip = "name the file with `--model`, or set `model` in [sync]";
        reporter.usage("nothing says where to write the model", tip)
    })
}

/// Learns a model of the voices of these jobs, writes it to `place` and uses it. Says what it did.
pub(super) fn train(
    jobs: &[Job],
    options: &mut SyncOptions,
    place: &Path,
    quiet: bool,
    reporter: &mut Reporter,
) -> Result<String, Abort> {
    if options.locale.is_none() {
        let tip = "name it with `--audio-locale`, or set `default-locale` in lipz.toml";
        return Err(reporter.usage("no locale of the recordings is named", tip));
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
                count => format!(" ({} left out: something else is said than their texts)", grouped(count)),
            };
            let told = format!("model learnt from {}{left_out}, in {shown}\n", of(&model));
            options.set_model(model);
            Ok(told)
        }
        None => {
            let told = known.as_ref().map(|model| format!("the model in {shown} is current: {}\n", of(model)));
            known.into_iter().for_each(|model| options.set_model(model));
            Ok(told.unwrap_or_default())
        }
    }
}

/// What a model was learnt from.
fn of(model: &TrainedModel) -> String {
    let minutes = f64::from(model.speech_s) / 60.0;
    format!(
        "{:.1} minutes of {} in {}",
        minutes,
        model.language.name(),
        counted(model.recordings as usize, "recording")
    )
}
