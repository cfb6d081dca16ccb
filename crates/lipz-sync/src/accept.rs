//! Recordings that say the texts of today, because somebody has listened to them.

use crate::clip::Clip;
use crate::facts::{content_hash, unreadable};
use crate::lints::{bytes_of, path_of};
use crate::originals::Originals;
use crate::recordings::shown;
use crate::spoken_now::SpokenNow;
use crate::{Recordings, Spoken, SyncRecord, threads};
use lipz_compiler::Input;
use lipz_compiler::settings::Settings;
use lipz_diagnostics::{DiagnosticsError, Report};
use std::fs::File;
use std::path::PathBuf;

/// A recording of which nobody has said that it says the text of today.
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub struct Unaccepted {
    /// The key of its clip.
    pub key: String,
    /// Its path, with `/`.
    pub recording: String,
    /// Whether it says another text, or is the dub of another one (LZ1915, LZ2006); otherwise nothing is known of it.
    pub is_outdated: bool,
    lipz_file: PathBuf,
    now: Spoken,
}

/// The recordings of clips with mouth shapes of which the record does not know that they say the texts of today, in the order of
/// the clips. Reads each recording whole.
///
/// `is_meant` says whether a clip is asked for, by its key and the locale that is spoken, if it is that of a voice; `progress` is
/// called for each clip. Both are called from several threads.
///
/// # Errors
/// A diagnostic for each recording or folder that cannot be read.
pub fn unaccepted(
    settings: &Settings,
    inputs: &[Input],
    record: &SyncRecord,
    is_meant: &(dyn Fn(&str, Option<&str>) -> bool + Sync),
    progress: &(dyn Fn() + Sync),
) -> Result<Vec<Unaccepted>, DiagnosticsError> {
    let (unaccepted, reports) = unaccepted_with_reports(settings, inputs, record, is_meant, progress);
    Ok(DiagnosticsError::check(unaccepted, reports)?.0)
}

/// The same of the recordings that can be read, and reports about the others.
///
/// For tools that report everything at once, such as the command `lipz`. All other programs call [`unaccepted`].
#[must_use = "the reports say whether recordings are missing"]
pub fn unaccepted_with_reports(
    settings: &Settings,
    inputs: &[Input],
    record: &SyncRecord,
    is_meant: &(dyn Fn(&str, Option<&str>) -> bool + Sync),
    progress: &(dyn Fn() + Sync),
) -> (Vec<Unaccepted>, Vec<Report>) {
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
    let mut unaccepted = Vec::new();
    for found in found {
        match found {
            Ok(found) => unaccepted.extend(found),
            Err(report) => reports.push(report),
        }
    }
    (unaccepted, reports)
}

fn one(
    settings: &Settings,
    recordings: &Recordings,
    originals: &Originals<'_>,
    record: &SyncRecord,
    input: &Input,
) -> Result<Option<Unaccepted>, Report> {
    let (Some(path), Some(lipz_file), Some(bytes)) = (recordings.find(&input.key), path_of(input), bytes_of(input))
    else {
        return Ok(None);
    };
    // Files that are no Lipz files are for `lipz check`.
    let Some(document) = lipz_file::parse(&bytes).document else { return Ok(None) };
    if Clip::from_document(&document, &settings.options).visemes.is_none() {
        return Ok(None);
    }
    let sound = File::open(path).and_then(content_hash).map_err(|error| unreadable(path, &error))?;
    let original = originals.of(&input.key, &lipz_file);
    let original_bytes = original.as_deref().and_then(bytes_of).unwrap_or_default();
    let original_document = lipz_file::parse(&original_bytes).document;
    let keyed = original.as_deref().zip(original_document.as_ref()).map(|(input, document)| (&*input.key, document));
    let said = SpokenNow::new(settings, recordings, sound, (&input.key, &document), keyed);
    let known = said.known(record, &lipz_file);
    let is_accepted = known.iter().any(|spoken| spoken.is_still(&said.now));
    Ok((!is_accepted && said.has_text()).then(|| Unaccepted {
        key: input.key.clone(),
        recording: shown(path),
        is_outdated: !known.is_empty(),
        lipz_file,
        now: said.now,
    }))
}

impl Unaccepted {
    /// Notes in the record that the recording says the text of today.
    pub fn accept(&self, record: &mut SyncRecord) {
        record.accept(&self.lipz_file, self.now);
    }
}
