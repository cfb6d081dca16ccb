//! Mouths that were made from another recording, or for another text.

use crate::Line;
use crate::clip::Clip;
use crate::recordings::shown;
use crate::sync::one::text_hash;
use lipz_diagnostics::{Code, Diagnostic, escape};
use std::path::Path;

/// Reports a mouth of which the record knows, but not from this recording and this text.
pub(super) fn check(
    clip: &Clip<'_>,
    spoken: Option<&str>,
    sound: u64,
    path: &Path,
    known: &[Line],
) -> Option<Diagnostic> {
    let (visemes, text) = (clip.visemes?, text_hash(spoken));
    if known.is_empty() || known.iter().any(|line| line.made.sound == sound && line.made.text == text) {
        return None;
    }
    let is_same_sound = known.iter().any(|line| line.made.sound == sound);
    let what = if is_same_sound { "for another text" } else { "from another recording" };
    Some(
        Diagnostic::at(Code::StaleMouth, visemes.span(), format!("the mouth was made {what}"))
            .note(format!("the recording is `{}`", escape::text(&shown(path))))
            .help("make the mouth again from the recording"),
    )
}
