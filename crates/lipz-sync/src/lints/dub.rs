//! Dubs that are older than what their original says.

use crate::clip::Clip;
use crate::recordings::shown;
use crate::{OriginalThen, Spoken};
use lipz_compiler::Input;
use lipz_diagnostics::{Code, Diagnostic, escape};
use std::path::Path;

/// Reports a dub of which the record knows that its original was another recording, or had another text, when it was recorded.
pub(super) fn check(
    clip: &Clip<'_>,
    (original, recording): (&Input, Option<&Path>),
    now: &Spoken,
    known: &[Spoken],
) -> Option<Diagnostic> {
    let (visemes, now) = (clip.visemes?, now.original?);
    let then: Vec<OriginalThen> = known.iter().filter_map(|spoken| spoken.original).collect();
    let is_same = |then: &&OriginalThen| then.is_recorded_as(&now);
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
    let help = "record the dub again; if it still says the same: `lipz accept`";
    Some(Diagnostic::at(Code::DubOutOfDate, visemes.span(), message).note(note).help(help))
}
