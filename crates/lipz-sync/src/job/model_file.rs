//! The file of a trained model in a project.

use crate::recordings::file_facts::unreadable;
use crate::recordings::paths::shown;
use lipz_compiler::replace_file;
use lipz_diagnostics::{Code, Report};
use lipz_speech::{Language, ModelError, Recogniser, RecogniserError, TrainedModel};
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;
use twox_hash::XxHash3_64;

/// Reads the model at `path`.
pub(super) fn read(path: &Path) -> Result<TrainedModel, Report> {
    let help = "train a model and write it to this path, or name a different file";
    let bytes = bytes(path, TrainedModel::LONGEST_FILE).map_err(|error| not_read(path, "model", help, &error))?;
    TrainedModel::from_bytes(&bytes).map_err(|error| unusable(path, error))
}

/// Reads the recogniser at `path`.
pub(super) fn read_recogniser(path: &Path) -> Result<Recogniser, Report> {
    let help = "convert a recogniser and write it to this path, or name a different file";
    let bytes = bytes(path, Recogniser::LONGEST_FILE).map_err(|error| not_read(path, "recogniser", help, &error))?;
    Recogniser::from_bytes(&bytes).map_err(|error| {
        let help = match error {
            RecogniserError::Damaged => "convert the recogniser again",
            _ => "name a different file",
        };
        Report::failure(shown(path), Code::UnusableModel, format!("the recogniser cannot be used: {error}"), help)
    })
}

fn not_read(path: &Path, what: &str, help: &str, error: &io::Error) -> Report {
    match error.kind() {
        io::ErrorKind::NotFound => {
            Report::failure(shown(path), Code::UnusableModel, format!("the {what} does not exist"), help)
        }
        _ => unreadable(path, error),
    }
}

/// Reads the model at `path` that is to be replaced. Returns `None` for a missing or damaged one.
///
/// # Errors
/// If it cannot be read, or is a different kind of file, which must not be replaced.
pub fn model_at(path: &Path) -> Result<Option<TrainedModel>, Report> {
    match bytes(path, TrainedModel::LONGEST_FILE).map(|bytes| TrainedModel::from_bytes(&bytes)) {
        Ok(Ok(model)) => Ok(Some(model)),
        Ok(Err(ModelError::Damaged)) => Ok(None),
        Ok(Err(error)) => Err(unusable(path, error)),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(error) => Err(unreadable(path, &error)),
    }
}

/// Writes a model, and reads it back, because the file stores rounded values.
///
/// # Errors
/// If it cannot be written. An existing file is then unchanged.
pub fn write_model(path: &Path, model: &TrainedModel) -> Result<TrainedModel, Report> {
    let bytes = model.to_bytes();
    let read = TrainedModel::from_bytes(&bytes).map_err(|error| unusable(path, error))?;
    replace_file(path, &bytes)?;
    Ok(read)
}

/// Returns the hash of a model's file.
pub(super) fn hash(model: &TrainedModel) -> u64 {
    XxHash3_64::oneshot(&model.to_bytes())
}

/// Returns the report about a model whose language is not the spoken one.
pub(super) fn other_language(path: &Path, model: &TrainedModel, spoken: Language) -> Report {
    let message =
        format!("the model was trained on {}, but the recordings are in {}", model.language.name(), spoken.name());
    Report::failure(
        shown(path),
        Code::UnusableModel,
        message,
        "name a different file, or train a model for this language",
    )
}

/// Reads a file up to the greatest useful size.
fn bytes(path: &Path, longest: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    File::open(path)?.take(longest + 1).read_to_end(&mut bytes)?;
    Ok(bytes)
}

fn unusable(path: &Path, error: ModelError) -> Report {
    let help = match error {
        ModelError::Damaged => "get it from version control, or train it again",
        _ => "name a different file",
    };
    Report::failure(shown(path), Code::UnusableModel, format!("the model cannot be used: {error}"), help)
}
