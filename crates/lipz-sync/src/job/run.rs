//! One job: converts a recording and its transcript to a Lipz file with visemes.

use crate::job::grid::{self, Grid};
use crate::job::loaded::{LoadedJob, spoken_in_original};
use crate::job::outcome::JobOutcome;
use crate::job::progress::Progress;
use crate::job::reports::push_report;
use crate::job::settings_hash::settings_hash;
use crate::job::store::{ClipStore, ReadOnlyClips};
use crate::job::{Job, SyncOptions};
use crate::record::hashes::{file_mouth_hash, text_hash, words};
use crate::record::{MouthHashes, SyncRecord};
use crate::recordings::clip::{ClipMouth, own_type};
use crate::recordings::file_facts::{hash_of, length_us, unreadable};
use crate::recordings::paths::shown;
use lipz_diagnostics::{Code, Diagnostic, Report, escape};
use lipz_file::format::{Style, format};
use lipz_file::{Document, Element, JsonString, Value};
use lipz_speech::Script;
use lipz_types::VisemeType;
use std::borrow::Cow;
use std::io;

/// Does a job, except for writing. Problems are added to `reports`.
pub(super) fn run(
    job: &Job,
    options: &SyncOptions,
    (record, place): (&SyncRecord, &dyn ClipStore),
    progress: &Progress<'_>,
    reports: &mut Vec<Report>,
) -> JobOutcome {
    match with_loaded(job, options, (record, place), reports, |loaded, reports| loaded.step(progress, reports)) {
        Ok(step) => step,
        Err(report) => {
            reports.push(report);
            JobOutcome::Refused
        }
    }
}

/// Returns the TextGrid of the current visemes, if these are up to date with the recording.
pub(super) fn textgrid(job: &Job, options: &SyncOptions, record: &SyncRecord) -> Option<String> {
    #[allow(clippy::redundant_closure_for_method_calls, reason = "the method is of one lifetime only")]
    let work = |loaded: LoadedJob<'_>, reports: &mut Vec<Report>| loaded.textgrid(reports);
    // Lip-sync runs report problems of the recording and the text.
    with_loaded(job, options, (record, &ReadOnlyClips), &mut Vec::new(), work).ok()?
}

/// Loads all inputs of a job except the decoded recording, and calls `work` with them. Problems are added to `reports`.
pub(super) fn with_loaded<R>(
    job: &Job,
    options: &SyncOptions,
    (record, place): (&SyncRecord, &dyn ClipStore),
    reports: &mut Vec<Report>,
    work: impl FnOnce(LoadedJob<'_>, &mut Vec<Report>) -> Result<R, Report>,
) -> Result<R, Report> {
    let name = shown(&job.lipz_file);
    let (is_new, bytes) = text_file(job, options, place.read(&job.lipz_file))?;
    let parsed = lipz_file::parse(&bytes);
    let is_whole = !parsed.diagnostics.iter().any(Diagnostic::is_error);
    let before = parsed.document.filter(|_| is_whole);
    let before = before.ok_or_else(|| Report::from_bytes(name.as_str(), &bytes, parsed.diagnostics))?;
    let clip = ClipMouth::from_document(&before, &options.options);
    let own_fps = before.get("fps").and(clip.fps);
    let rate = (options.viseme_type_of(own_type(&before)), options.fps_of(own_fps));
    // A dub without a text uses that of its original.
    let original_file = original_file(job, place);
    let original = lipz_file::parse(&original_file.1).document;
    let own = options.spoken(job, &before);
    let (is_borrowed, mut of_text) = (own.is_none(), Vec::new());
    let spoken = own.or_else(|| options.spoken(job, original.as_ref()?));
    let to_read = spoken.as_ref().filter(|_| rate.0 != VisemeType::Rms);
    let script = to_read.map(|spoken| script(spoken, options, &mut of_text)).unwrap_or_default();
    let (locale, text) = spoken.as_ref().map_or((None, None), |(locale, text)| (locale.as_deref(), Some(*text)));
    let sound = hash_of(&job.recording)?;
    let textgrids = options.textgrids.as_deref().filter(|_| rate.0 != VisemeType::Rms);
    let grid_place = textgrids.map(|folder| grid::place(folder, &job.key));
    let (grid, odd_grid) =
        grid_place.as_deref().map(|place| Grid::read(place, &script)).transpose()?.unwrap_or_default();
    let known_lines = record.lines_for(&job.lipz_file);
    let settings_with = |grid: Option<&Grid>| settings_hash(options, locale, &script, rate, grid);
    // A TextGrid with which visemes of this recording were made has the right length. Others must be checked.
    let was_used = |grid: &Grid| {
        let settings = settings_with(Some(grid));
        known_lines.iter().any(|line| (line.made.sound, line.made.settings) == (sound, settings))
    };
    let unfit = grid.as_ref().filter(|grid| !was_used(grid));
    let unfit = unfit.and_then(|grid| grid.fits(length_us(&job.recording).ok()?, rate.1).err());
    let grid = grid.filter(|_| unfit.is_none());
    let unfit = grid_place.as_ref().zip(unfit).map(|(place, unfit)| Report::about(shown(place), *unfit));
    push_report(reports, options, odd_grid.or(unfit));
    let spoken_text = text.map(|text| &*text.text);
    let made = MouthHashes {
        sound,
        text: text_hash(spoken_text),
        settings: settings_with(grid.as_ref()),
        mouth: file_mouth_hash(&before, &clip, &options.options),
    };
    let known = known_lines.iter().map(|line| line.renewed(spoken_text)).collect();
    let of_original = spoken_in_original(job, original.as_ref(), options);
    let recorded = record.spoken_now(&job.lipz_file, sound, spoken_text, of_original);
    let (original, original_file) = (original.as_ref(), (&*original_file.0, &*original_file.1));
    let (name, bytes, before) = (&*name, &*bytes, &before);
    let loaded = LoadedJob {
        job,
        options,
        name,
        bytes,
        is_new,
        before,
        clip,
        rate,
        original_file,
        original,
        locale,
        text,
        is_borrowed,
        script,
        grid_place,
        grid,
        made,
        known,
        recorded,
        diagnostics: Vec::from_iter(other_text(job, text.filter(|_| !is_borrowed)).filter(|_| !is_new)),
        of_text,
    };
    work(loaded, reports)
}

/// Returns the name and the bytes of the Lipz file of a dub's original. Both are empty for other files, and the
/// bytes also if the file cannot be read.
fn original_file(job: &Job, place: &dyn ClipStore) -> (String, Vec<u8>) {
    let Some(original) = &job.original else { return Default::default() };
    (shown(&original.lipz_file), place.read(&original.lipz_file).unwrap_or_default())
}

/// Returns whether the Lipz file of a job is new, and its bytes; for a new one, its content without visemes.
pub(crate) fn text_file(
    job: &Job,
    options: &SyncOptions,
    read: io::Result<Vec<u8>>,
) -> Result<(bool, Vec<u8>), Report> {
    match read {
        Ok(bytes) => Ok((false, bytes)),
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            let style = Style { default_locale: options.options.get_default_locale(), ..Style::default() };
            Ok((true, format(&new_document(job, options), style).into_bytes()))
        }
        Err(error) => Err(unreadable(&job.lipz_file, &error)),
    }
}

/// Returns the words of a locale's spoken text. Reports its problems.
fn script(
    (locale, text): &(Option<String>, &JsonString<'_>),
    options: &SyncOptions,
    diagnostics: &mut Vec<Diagnostic>,
) -> Script {
    let reading = options.pronouncer(locale.as_deref()).read(&text.text);
    diagnostics.extend(reading.problems.iter().map(|problem| {
        let span = text.span_of(problem.range.clone());
        Diagnostic::at(Code::Pronunciation, span, problem.kind.to_string()).help(problem.kind.help())
    }));
    reading.script
}

/// Returns the document of a new file, with its text.
fn new_document(job: &Job, options: &SyncOptions) -> Document<'static> {
    let string = |text: String| JsonString::from(Cow::Owned(text));
    let element =
        |text: &String| Element { name: string(options.text_element(job)), value: Value::String(string(text.clone())) };
    Document { elements: job.text.iter().map(element).collect() }
}

/// Reports a text of the script that differs from the one in the file, which stays.
fn other_text(job: &Job, spoken: Option<&JsonString<'_>>) -> Option<Diagnostic> {
    let text = job.text.as_ref()?;
    let Some(spoken) = spoken else {
        return Some(
            Diagnostic::new(Code::OtherText, "the file has no text, but the script has one")
                .help("add the text to the file"),
        );
    };
    let is_same = words(text).eq(words(&spoken.text));
    let message = format!("the script has a different text: {}", escape::quoted(text));
    (!is_same).then(|| {
        Diagnostic::at(Code::OtherText, spoken.span(), message)
            .note("lipz uses the text of the Lipz file")
            .help("make the two texts equal")
    })
}
