//! Whether clips and recordings belong together.

mod length;
mod stale;
mod voice;

use crate::clip::Clip;
use crate::heard::Ear;
use crate::recordings::shown;
use crate::{Recordings, SyncRecord, record_place, spoken_text, threads};
use lipz_compiler::settings::Settings;
use lipz_compiler::{Content, Input};
use lipz_diagnostics::{Code, Diagnostic, Report, escape};
use std::borrow::Cow;
use std::fs;
use std::path::Path;

/// Reports clips without a recording, recordings without a clip, and pairs that do not fit. Nothing, if the project has
/// no folder of recordings. Files that are no Lipz files are for [`Compiler::check`](lipz_compiler::Compiler::check).
///
/// `progress` is called for each clip, from several threads.
pub fn check(settings: &Settings, inputs: &[Input], progress: &(dyn Fn() + Sync)) -> Vec<Report> {
    if settings.audio.folder.is_none() {
        return Vec::new();
    }
    let (recordings, mut reports) = Recordings::discover(&settings.audio);
    if lipz_diagnostics::reports::have_errors(&reports) {
        return reports; // whatever is missing may be where nobody could look
    }
    let (ear, record) = match (Ear::open(settings.audio.cache.as_deref()), SyncRecord::read(&record_place(settings))) {
        (Ok(ear), Ok((record, odd_lines))) => {
            reports.extend(odd_lines);
            (ear, record)
        }
        (ear, record) => {
            reports.extend(ear.err());
            reports.extend(record.err());
            return reports;
        }
    };
    for path in recordings.without_clip(inputs) {
        let message = format!("no clip has the recording `{}`", escape::text(&shown(path)));
        let help = "add a Lipz file, or remove the recording";
        reports.push(Report::failure(shown(path), Code::RecordingWithoutClip, message, help));
    }
    let found = threads::map(inputs, settings.options.threads, |input| {
        let report = one(settings, input, recordings.find(&input.key), &ear, &record);
        progress();
        report
    });
    reports.extend(found.into_iter().flatten());
    reports.extend(ear.remember().err());
    for report in &mut reports {
        settings.options.levels.apply(&mut report.diagnostics);
    }
    lipz_diagnostics::reports::sort(&mut reports);
    reports
}

/// Compares a clip with its recording.
fn one(settings: &Settings, input: &Input, recording: Option<&Path>, ear: &Ear, record: &SyncRecord) -> Vec<Report> {
    let bytes = match &input.content {
        Content::Bytes { bytes, .. } => Cow::Borrowed(bytes.as_slice()),
        Content::File(path) => match fs::read(path) {
            Ok(bytes) => Cow::Owned(bytes),
            Err(_) => return Vec::new(),
        },
    };
    let Some(document) = lipz_file::parse(&bytes).document else { return Vec::new() };
    let clip = Clip::from_document(&document, &settings.options);
    let Some(path) = recording else {
        let diagnostic = clip.visemes.filter(|_| !clip.codes.is_empty()).map(|visemes| {
            Diagnostic::at(Code::ClipWithoutRecording, visemes.span(), "the clip has mouth shapes, but no recording")
                .help(without_recording(settings, &input.key))
        });
        return diagnostic
            .map(|diagnostic| Report::from_bytes(input.name(), &bytes, vec![diagnostic]))
            .into_iter()
            .collect();
    };
    let (facts, heard) = match ear.listen(path) {
        Ok(heard) => heard,
        Err(report) => return vec![report],
    };
    let mut diagnostics = Vec::from_iter(length::check(&clip, path, facts, settings.audio.tolerance_ms));
    if let Content::File(lipz_file) = &input.content {
        let spoken = spoken_text(settings, &document);
        diagnostics.extend(stale::check(&clip, spoken, facts.content_hash, path, record.made_for(lipz_file)));
    }
    // Of a mouth of another length, every other place is wrong, too.
    if diagnostics.is_empty() {
        diagnostics = voice::check(&clip, &heard);
    }
    vec![Report::from_bytes(input.name(), &bytes, diagnostics)]
}

/// Where the recording was looked for.
fn without_recording(settings: &Settings, key: &str) -> String {
    let folder = settings.audio.folder.as_deref().unwrap_or(Path::new(""));
    let pattern = settings.audio.pattern.as_deref().unwrap_or(lipz_compiler::settings::KEY);
    let place = shown(&folder.join(pattern.replace(lipz_compiler::settings::KEY, key)));
    format!("record it as `{place}` (`folder` and `pattern` of [audio] say where recordings are), or remove `visemes`")
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests;
