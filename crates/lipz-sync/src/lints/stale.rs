//! Visemes made from a different recording, and recordings that are older than their text.

use crate::record::{RecordLine, RecordedText};
use crate::recordings::clip::ClipMouth;
use crate::recordings::paths::shown;
use lipz_diagnostics::{Code, Diagnostic, escape};
use std::path::Path;

/// Reports a recording whose text has changed, according to the record, and visemes that were only made from different
/// recordings.
pub(super) fn check(
    clip: &ClipMouth<'_>,
    now: &RecordedText,
    path: &Path,
    known: &[RecordedText],
    made: &[RecordLine],
) -> Option<Diagnostic> {
    let visemes = clip.visemes?;
    if known.iter().any(|spoken| spoken.text == now.text) || known.is_empty() && made.is_empty() {
        return None;
    }
    let (code, message, help) = match known.is_empty() {
        false => (
            Code::OutdatedRecording,
            "the recording is older than its text",
            "record the line again, or run `lipz approve` if the recording matches the text",
        ),
        true => (
            Code::StaleMouth,
            "the visemes were made from a different recording",
            "make the visemes again from the recording",
        ),
    };
    let note = format!("the recording is `{}`", escape::text(&shown(path)));
    Some(Diagnostic::at(code, visemes.span(), message).note(note).help(help))
}
