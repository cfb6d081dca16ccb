//! Lints that compare clips with recordings.

mod dub;
mod dub_length;
mod length;
mod missing;
mod recording_counts;
mod stale;
mod voice;

pub use recording_counts::RecordingCounts;

use crate::job::grid;
use crate::job::mouth::mismatches;
use crate::record::expected_text::ExpectedText;
use crate::record::{SyncRecord, record_place};
use crate::recordings::Recordings;
use crate::recordings::clip::ClipMouth;
use crate::recordings::finder::not_used;
use crate::recordings::inputs::{bytes_of, path_of};
use crate::recordings::loudness::LoudnessCache;
use crate::recordings::originals::Originals;
use crate::recordings::paths::shown;
use crate::threads;
use lipz_compiler::settings::Settings;
use lipz_compiler::{Input, WordTimes};
use lipz_diagnostics::{Code, Diagnostic, Report, escape};

/// Reports clips without a recording, recordings without a clip, and pairs that do not match. Reports nothing if the
/// project has no folder of recordings. Invalid Lipz files are reported by
/// [`Compiler::check`](lipz_compiler::Compiler::check).
///
/// `progress` is called for each clip, from several threads.
pub fn check(settings: &Settings, inputs: &[Input], progress: &(dyn Fn() + Sync)) -> Vec<Report> {
    if settings.audio.folder.is_none() {
        return Vec::new();
    }
    let (recordings, mut reports) = Recordings::discover_with_reports(settings);
    if lipz_diagnostics::reports::have_errors(&reports) {
        return reports; // missing recordings may be in unreadable folders
    }
    let (ear, record) =
        match (LoudnessCache::open(settings.audio.cache.as_deref()), SyncRecord::read(&record_place(settings))) {
            (Ok(ear), Ok(record)) => {
                reports.extend_from_slice(record.warnings());
                (ear, record)
            }
            (ear, record) => {
                reports.extend(ear.err());
                reports.extend(record.err());
                return reports;
            }
        };
    reports.extend(not_used(&recordings));
    for path in recordings.without_clip(inputs) {
        let message = format!("the recording `{}` does not belong to a clip", escape::text(&shown(path)));
        let help = "add a Lipz file, or remove the recording";
        reports.push(Report::failure(shown(path), Code::RecordingWithoutClip, message, help));
    }
    let originals = Originals::new(recordings.voices(), inputs);
    let found = threads::map(inputs, settings.options.get_threads(), |input| {
        let original = originals.of(&input.key, input.name().as_ref());
        let reports = one(settings, (input, original.as_deref()), &recordings, &ear, &record);
        progress();
        reports
    });
    reports.extend(found.into_iter().flatten());
    reports.extend(ear.remember().err());
    reports.iter_mut().for_each(|report| settings.options.apply_levels(report));
    lipz_diagnostics::reports::sort(&mut reports);
    reports
}

/// Whether a clip with visemes lacks a recording in some language.
pub(crate) fn is_unrecorded(settings: &Settings, clip: &ClipMouth<'_>, recordings: &Recordings, key: &str) -> bool {
    !missing::check(settings, clip, recordings, key).is_empty()
}

/// Compares a clip with its recordings.
fn one(
    settings: &Settings,
    (input, original): (&Input, Option<&Input>),
    recordings: &Recordings,
    ear: &LoudnessCache,
    record: &SyncRecord,
) -> Vec<Report> {
    let Some(bytes) = bytes_of(input) else { return Vec::new() };
    let original_bytes = original.and_then(bytes_of).unwrap_or_default();
    let original_document = lipz_file::parse(&original_bytes).document;
    let Some(document) = lipz_file::parse(&bytes).document else { return Vec::new() };
    let clip = ClipMouth::from_document(&document, &settings.options);
    let mut reports = Vec::new();
    let mut diagnostics = Vec::from_iter(missing::check(settings, &clip, recordings, &input.key));
    for path in recordings.dubs(&input.key).into_iter().filter_map(|(_, path)| path) {
        match ear.listen(path) {
            Ok((_, heard)) => reports.extend(heard.condition.report(path)),
            Err(report) => reports.push(report),
        }
    }
    let heard = recordings.find(&input.key).map(|path| (path, ear.listen(path)));
    if original.is_none() {
        let length_us = match &heard {
            Some((_, Ok((facts, _)))) => Some(facts.length_us),
            _ => clip.length_us().filter(|length_us| *length_us > 0),
        };
        reports.extend(length_us.into_iter().flat_map(|us| dub_length::check(settings, recordings, (&input.key, us))));
    }
    match heard {
        None => {}
        Some((_, Err(report))) => reports.push(report),
        Some((path, Ok((facts, heard)))) => {
            let mut condition = heard.condition;
            let before = diagnostics.len();
            diagnostics.extend(length::check(&clip, path, facts, settings.audio.tolerance_ms));
            if let Some((folder, fps)) = settings.sync.textgrids.as_deref().zip(clip.fps) {
                reports.extend(grid::check(&grid::place(folder, &input.key), path, fps));
            }
            if let Some(lipz_file) = &path_of(input) {
                let known = record.lines_for(lipz_file);
                let of_original = original.zip(original_document.as_ref());
                let keyed = of_original.map(|(input, document)| (&*input.key, document));
                let said = ExpectedText::new(settings, recordings, facts.content_hash, (&input.key, &document), keyed);
                let recorded = said.known(record, lipz_file);
                diagnostics.extend(stale::check(&clip, &said.now, path, &recorded, known));
                // The mismatches found by the run that made the visemes still apply. If there are several lines after a
                // merge, the last one counts.
                let made = known.iter().rev().find(|line| line.made.sound == facts.content_hash);
                let differences = made.and_then(|line| line.differences.as_ref());
                let locale = recordings.locale(&input.key);
                match crate::recordings::transcript::spoken_string(settings, locale, &document) {
                    Some(text) => {
                        if made.is_some_and(|line| line.is_said(&text.text)) {
                            condition = condition.with_speech();
                        }
                        diagnostics.extend(mismatches(differences, text));
                    }
                    None => reports.extend(of_borrowed(settings, locale, input, original, differences)),
                }
                if let Some(original) = original {
                    let original = (original, recordings.find(&original.key));
                    diagnostics.extend(dub::check(&clip, original, &said.now, &recorded));
                }
            }
            reports.extend(condition.report(path));
            // If the length of the visemes is wrong, further positions would be wrong as well.
            if diagnostics.len() == before {
                diagnostics.extend(voice::check(&clip, &heard));
            }
        }
    }
    if !diagnostics.is_empty() {
        reports.push(Report::from_bytes(input.name(), &bytes, diagnostics));
    }
    reports
}

/// Returns the mismatches of a dub that uses the text of its original.
fn of_borrowed(
    settings: &Settings,
    locale: Option<&str>,
    dub: &Input,
    original: Option<&Input>,
    differences: Option<&WordTimes>,
) -> Option<Report> {
    let (original, bytes) = (original?, bytes_of(original?)?);
    let document = lipz_file::parse(&bytes).document?;
    let found = mismatches(differences, crate::recordings::transcript::spoken_string(settings, locale, &document)?);
    let note = format!("the dub is {}", escape::quoted(&dub.key));
    let found: Vec<Diagnostic> = found.into_iter().map(|diagnostic| diagnostic.note(note.clone())).collect();
    (!found.is_empty()).then(|| Report::from_bytes(original.name(), &bytes, found))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests;
