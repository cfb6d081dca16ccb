//! Dubs that are older than their original.

use crate::record::{OriginalHashes, RecordedText};
use crate::recordings::clip::ClipMouth;
use crate::recordings::paths::shown;
use lipz_compiler::Input;
use lipz_diagnostics::{Code, Diagnostic, escape};
use std::path::Path;

/// Reports a dub whose original has changed its recording or text since the dub was recorded, according to the record.
pub(super) fn check(
    clip: &ClipMouth<'_>,
    (original, recording): (&Input, Option<&Path>),
    now: &RecordedText,
    known: &[RecordedText],
) -> Option<Diagnostic> {
    let (visemes, now) = (clip.visemes?, now.original?);
    let then: Vec<OriginalHashes> = known.iter().filter_map(|spoken| spoken.original).collect();
    let is_same = |then: &&OriginalHashes| then.is_recorded_as(&now);
    if then.is_empty() || then.iter().filter(is_same).any(|then| then.text == now.text) {
        return None;
    }
    let is_same_sound = then.iter().any(|then| is_same(&then));
    let message = match is_same_sound {
        true => "the text of the original has changed since the dub was made",
        false => "the original was recorded again after the dub was made",
    };
    let name = escape::text(&original.name()).into_owned();
    let note = match recording.filter(|_| !is_same_sound) {
        Some(path) => format!("its recording is `{}`", escape::text(&shown(path))),
        None => format!("it is `{name}`"),
    };
    let help = "record the dub again, or run `lipz approve` if it is still correct";
    Some(Diagnostic::at(Code::DubOutOfDate, visemes.span(), message).note(note).help(help))
}
