//! Mouths that were made from another recording, and recordings that are older than their text.

use crate::Line;
use crate::clip::Clip;
use crate::recordings::shown;
use crate::sync::hashes::text_hash;
use lipz_diagnostics::{Code, Diagnostic, escape};
use std::path::Path;

/// Reports a mouth of which the record knows, but not from this recording and this text: one of the two has changed.
pub(super) fn check(
    clip: &Clip<'_>,
    spoken: Option<&str>,
    sound: u64,
    path: &Path,
    known: &[Line],
) -> Option<Diagnostic> {
    let (visemes, text) = (clip.visemes?, text_hash(spoken));
    let known: Vec<Line> = known.iter().map(|line| line.renewed(spoken)).collect();
    if known.is_empty() || known.iter().any(|line| line.made.sound == sound && line.made.text == text) {
        return None;
    }
    let is_same_sound = known.iter().any(|line| line.made.sound == sound);
    let (code, message, help) = match is_same_sound {
        true => (
            Code::OutdatedRecording,
            "the recording is older than its text",
            "record the line again; if its words are the same, make the mouth again, for this text",
        ),
        false => {
            (Code::StaleMouth, "the mouth was made from another recording", "make the mouth again from the recording")
        }
    };
    let note = format!("the recording is `{}`", escape::text(&shown(path)));
    Some(Diagnostic::at(code, visemes.span(), message).note(note).help(help))
}
