//! Approval of recordings: a person confirms that they match the current texts.

use crate::record::expected_text::ExpectedText;
use crate::record::{RecordedText, SyncRecord};
use crate::recordings::Recordings;
use crate::recordings::clip::ClipMouth;
use crate::recordings::file_facts::{content_hash, unreadable};
use crate::recordings::inputs::{bytes_of, path_of};
use crate::recordings::originals::Originals;
use crate::recordings::paths::shown;
use crate::threads;
use lipz_compiler::Input;
use lipz_compiler::settings::Settings;
use lipz_diagnostics::{DiagnosticsError, Report};
use std::fs::File;
use std::path::PathBuf;

/// A recording that is not confirmed for the current text.
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub struct UnapprovedRecording {
    /// The key of its clip.
    pub key: String,
    /// Its path, with `/`.
    pub recording: String,
    /// Whether it was made for a different text, or is the dub of a different original (LZ1915, LZ2006). Otherwise the
    /// record has no information about it.
    pub is_outdated: bool,
    lipz_file: PathBuf,
    now: RecordedText,
}

/// Returns the recordings of clips with visemes that the record does not confirm for the current texts, in the order of
/// the clips. Reads each recording completely.
///
/// `is_meant` selects clips by key and by spoken locale, if that is the locale of a voice; `progress` is called for
/// each clip. Both are called from several threads.
///
/// # Errors
/// A diagnostic for each recording or folder that cannot be read.
pub fn unapproved(
    settings: &Settings,
    inputs: &[Input],
    record: &SyncRecord,
    is_meant: &(dyn Fn(&str, Option<&str>) -> bool + Sync),
    progress: &(dyn Fn() + Sync),
) -> Result<Vec<UnapprovedRecording>, DiagnosticsError> {
    let (unapproved, reports) = unapproved_with_reports(settings, inputs, record, is_meant, progress);
    Ok(DiagnosticsError::check(unapproved, reports)?.0)
}

/// Returns the same for the readable recordings, and reports about the others.
///
/// For tools that report everything at once, such as the command `lipz`. All other programs call [`unapproved`].
#[must_use = "check the reports for missing recordings"]
pub fn unapproved_with_reports(
    settings: &Settings,
    inputs: &[Input],
    record: &SyncRecord,
    is_meant: &(dyn Fn(&str, Option<&str>) -> bool + Sync),
    progress: &(dyn Fn() + Sync),
) -> (Vec<UnapprovedRecording>, Vec<Report>) {
    if settings.audio.folder.is_none() {
        return Default::default();
    }
    let (recordings, mut reports) = Recordings::discover_with_reports(settings);
    let originals = Originals::new(recordings.voices(), inputs);
    let found = threads::map(inputs, settings.options.get_threads(), |input| {
        let is_meant = is_meant(&input.key, recordings.locale(&input.key));
        let found = if is_meant { one(settings, &recordings, &originals, record, input) } else { Ok(None) };
        progress();
        found
    });
    let mut unapproved = Vec::new();
    for found in found {
        match found {
            Ok(found) => unapproved.extend(found),
            Err(report) => reports.push(report),
        }
    }
    (unapproved, reports)
}

fn one(
    settings: &Settings,
    recordings: &Recordings,
    originals: &Originals<'_>,
    record: &SyncRecord,
    input: &Input,
) -> Result<Option<UnapprovedRecording>, Report> {
    let (Some(path), Some(lipz_file), Some(bytes)) = (recordings.find(&input.key), path_of(input), bytes_of(input))
    else {
        return Ok(None);
    };
    // `lipz check` reports invalid Lipz files.
    let Some(document) = lipz_file::parse(&bytes).document else { return Ok(None) };
    if ClipMouth::from_document(&document, &settings.options).visemes.is_none() {
        return Ok(None);
    }
    let sound = File::open(path).and_then(content_hash).map_err(|error| unreadable(path, &error))?;
    let original = originals.of(&input.key, &lipz_file);
    let original_bytes = original.as_deref().and_then(bytes_of).unwrap_or_default();
    let original_document = lipz_file::parse(&original_bytes).document;
    let keyed = original.as_deref().zip(original_document.as_ref()).map(|(input, document)| (&*input.key, document));
    let said = ExpectedText::new(settings, recordings, sound, (&input.key, &document), keyed);
    let known = said.known(record, &lipz_file);
    let is_approved = known.iter().any(|spoken| spoken.is_still(&said.now));
    Ok((!is_approved && said.has_text()).then(|| UnapprovedRecording {
        key: input.key.clone(),
        recording: shown(path),
        is_outdated: !known.is_empty(),
        lipz_file,
        now: said.now,
    }))
}

impl UnapprovedRecording {
    /// Records that the recording matches the current text.
    pub fn approve(&self, record: &mut SyncRecord) {
        record.approve(&self.lipz_file, self.now);
    }
}
