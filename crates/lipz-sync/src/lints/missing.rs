//! Clips without a recording, in any or all languages.

use crate::recordings::Recordings;
use crate::recordings::clip::ClipMouth;
use crate::recordings::paths::shown;
use lipz_compiler::settings::Settings;
use lipz_diagnostics::{Code, Diagnostic, escape};
use std::path::Path;

/// Reports visemes without a recording, and the languages in which the line is not recorded.
pub(super) fn check(settings: &Settings, clip: &ClipMouth<'_>, recordings: &Recordings, key: &str) -> Vec<Diagnostic> {
    let Some(visemes) = clip.visemes.filter(|_| !clip.codes.is_empty()) else { return Vec::new() };
    let mut found = Vec::new();
    if recordings.find(key).is_none() {
        let folder = settings.audio.folder.as_deref().unwrap_or(Path::new(""));
        let place = shown(&folder.join(recordings.place(key)));
        let help = format!(
            "record it as `{place}`, correct [audio] or [voices], which set the paths of recordings, or remove \
                `visemes`"
        );
        let message = "the clip has visemes, but no recording";
        let diagnostic = Diagnostic::at(Code::ClipWithoutRecording, visemes.span(), message).help(help);
        let unread = recordings.unread_of(key).map(|path| escape::text(&shown(path)).into_owned());
        found.push(match unread {
            Some(path) => diagnostic.note(format!("`{path}` exists, but its format is not supported")),
            None => diagnostic,
        });
    }
    let dubs = recordings.dubs(key);
    let missing: Vec<String> =
        dubs.iter().filter(|(_, path)| path.is_none()).map(|(locale, _)| format!("`{locale}`")).collect();
    if !missing.is_empty() {
        let message = format!("the clip has no recording in {}", missing.join(", "));
        let help = "record the line in these languages, or correct the paths of their recordings in [voices]";
        found.push(Diagnostic::at(Code::ClipWithoutRecording, visemes.span(), message).help(help));
    }
    found
}
