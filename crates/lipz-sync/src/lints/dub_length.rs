//! Dubs that are too short or too long for their line.

use super::length::seconds;
use crate::recordings::paths::shown;
use crate::recordings::{FileFacts, Recordings};
use lipz_compiler::settings::Settings;
use lipz_diagnostics::{Code, Diagnostic, Report, escape};

/// Reports the dubs of an original whose recordings are outside the range of the line's sync status. `original` is the
/// key of the original, and its length in microseconds.
pub(super) fn check(settings: &Settings, recordings: &Recordings, (original, original_us): (&str, u64)) -> Vec<Report> {
    let status = settings.audio.sync_statuses.of(original);
    let Some(allowed) = status.range_us(original_us) else { return Vec::new() };
    let voices = recordings.voices();
    let mut reports = Vec::new();
    for locale in voices.patterns.keys().filter(|locale| voices.original.as_ref() != Some(*locale)) {
        let Some(path) = voices.dub_of(original, locale).and_then(|key| recordings.find(&key)) else { continue };
        let length_us = match FileFacts::length_us(path) {
            Ok(length_us) if allowed.contains(&length_us) => continue,
            Ok(length_us) => length_us,
            // The lints of the dub report it.
            Err(_) => continue,
        };
        let (lasts, start, end) = (seconds(length_us), seconds(*allowed.start()), seconds(*allowed.end()));
        let message = format!("the dub in {locale} lasts {lasts}, but {start} to {end} are allowed");
        let (key, lasts, status) = (escape::quoted(original), seconds(original_us), status.label());
        let note = format!("the original {key} lasts {lasts}, and its sync status is {status}");
        let help = "record the line again, shorten its translation, or change its sync status in [dubs]";
        let found = Diagnostic::new(Code::DubLength, message).note(note).help(help);
        reports.push(Report::about(shown(path), found));
    }
    reports
}
