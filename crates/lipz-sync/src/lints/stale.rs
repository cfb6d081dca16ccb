//! Mouths that were made from another recording, and recordings that are older than their text.

use crate::clip::Clip;
use crate::recordings::shown;
use crate::{Line, Spoken};
use lipz_diagnostics::{Code, Diagnostic, escape};
use std::path::Path;

/// Reports a recording of which the record knows that it says another text, and a mouth that was made from none but another recording.
pub(super) fn check(clip: &Clip<'_>, now: &Spoken, path: &Path, known: &[Spoken], made: &[Line]) -> Option<Diagnostic> {
    let visemes = clip.visemes?;
    if known.iter().any(|spoken| spoken.text == now.text) || known.is_empty() && made.is_empty() {
        return None;
    }
    let (code, message, help) = match known.is_empty() {
        false => (
            Code::OutdatedRecording,
            "the recording is older than its text",
            "record the line again; if it says the text all the same: `lipz accept`",
        ),
        true => {
            (Code::StaleMouth, "the mouth was made from another recording", "make the mouth again from the recording")
        }
    };
    let note = format!("the recording is `{}`", escape::text(&shown(path)));
    Some(Diagnostic::at(code, visemes.span(), message).note(note).help(help))
}
