//! One job: from a recording and what is said in it to a Lipz file with a mouth.

use super::grid::{self, Grid};
use super::hashes::{mouth_hash, settings_hash, text_hash, words};
use super::listed::Listed;
use super::progress::Progress;
use super::record::{Line, Made};
use super::spoken::Spoken;
use super::subject::{Subject, spoken_in_original};
use super::{Job, OnDisk, Place, SyncOptions, SyncRecord};
use crate::clip::{Clip, string};
use crate::facts::{content_hash, length_us, unreadable};
use crate::recordings::shown;
use lipz_diagnostics::{Code, Diagnostic, Report, escape};
use lipz_file::format::{Style, format};
use lipz_file::{Document, Element, JsonString, Value};
use lipz_speech::Script;
use lipz_types::VisemeType;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};

/// What becomes of a job.
pub(crate) enum Step {
    /// The mouth is what it would become.
    Unchanged(Listed),
    /// The mouth was made or changed by hand, and stays.
    Kept(Kept),
    /// The file gets a mouth.
    New(Box<New>),
    /// There are errors.
    Refused,
}

/// Why a mouth stays.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub enum Kept {
    /// It was changed by hand after it had been made of a recording.
    Changed,
    /// The record does not know it: somebody drew it, or another tool.
    ByHand,
    /// It was made from a TextGrid that somebody had corrected, and this run has no TextGrids.
    Corrected,
}

/// A file to be written.
pub(crate) struct New {
    /// What the file was; `None` if there is none.
    pub(crate) before: Option<Vec<u8>>,
    pub(crate) after: String,
    pub(crate) line: Line,
    /// What the recording says, if the mouth is made for other words.
    pub(crate) outdated: Vec<Spoken>,
    pub(crate) listed: Listed,
    /// The TextGrid that is not there yet, and its place.
    pub(crate) grid: Option<(PathBuf, String)>,
    /// Whether the mouth was made from this recording before, when the text was another one.
    pub(crate) has_new_text: bool,
}

/// Does a job, all but writing. What is wrong goes to `reports`.
pub(super) fn one(
    job: &Job,
    options: &SyncOptions,
    (record, place): (&SyncRecord, &dyn Place),
    progress: &Progress<'_>,
    reports: &mut Vec<Report>,
) -> Step {
    match with_subject(job, options, (record, place), reports, |subject, reports| subject.step(progress, reports)) {
        Ok(step) => step,
        Err(report) => {
            reports.push(report);
            Step::Refused
        }
    }
}

/// The TextGrid of the mouth that is there, if it is what the recording makes of it.
pub(super) fn textgrid(job: &Job, options: &SyncOptions, record: &SyncRecord) -> Option<String> {
    #[allow(clippy::redundant_closure_for_method_calls, reason = "the method is of one lifetime only")]
    let work = |subject: Subject<'_>, reports: &mut Vec<Report>| subject.textgrid(reports);
    // What is wrong with recording and text, runs that make mouths tell.
    with_subject(job, options, (record, &OnDisk), &mut Vec::new(), work).ok()?
}

/// Finds out all that is known of a job before its recording is decoded, and does something with it. What is odd goes to
/// `reports`.
pub(super) fn with_subject<R>(
    job: &Job,
    options: &SyncOptions,
    (record, place): (&SyncRecord, &dyn Place),
    reports: &mut Vec<Report>,
    work: impl FnOnce(Subject<'_>, &mut Vec<Report>) -> Result<R, Report>,
) -> Result<R, Report> {
    let name = shown(&job.lipz_file);
    let (is_new, bytes) = text_file(job, options, place.read(&job.lipz_file))?;
    let parsed = lipz_file::parse(&bytes);
    let is_whole = !parsed.diagnostics.iter().any(Diagnostic::is_error);
    let before = parsed.document.filter(|_| is_whole);
    let before = before.ok_or_else(|| Report::from_bytes(name.as_str(), &bytes, parsed.diagnostics))?;
    let clip = Clip::from_document(&before, &options.options);
    let own_fps = before.get("fps").and(clip.fps);
    let rate = (options.viseme_type_of(own_type(&before)), options.fps_of(own_fps));
    // A dub without a text has that of its original.
    let original_file = original_file(job, place);
    let original = lipz_file::parse(&original_file.1).document;
    let own = options.spoken(job, &before);
    let (is_borrowed, mut of_text) = (own.is_none(), Vec::new());
    let spoken = own.or_else(|| options.spoken(job, original.as_ref()?));
    let to_read = spoken.as_ref().filter(|_| rate.0 != VisemeType::Rms);
    let script = to_read.map(|spoken| script(spoken, options, &mut of_text)).unwrap_or_default();
    let (locale, text) = spoken.as_ref().map_or((None, None), |(locale, text)| (locale.as_deref(), Some(*text)));
    let sound = hash_of(&job.recording)?;
    let own_type = own_type(&before).or(options.options.get_default_viseme_type());
    let textgrids = options.textgrids.as_deref().filter(|_| rate.0 != VisemeType::Rms);
    let grid_place = textgrids.map(|folder| grid::place(folder, &job.key));
    let (grid, odd_grid) =
        grid_place.as_deref().map(|place| Grid::read(place, &script)).transpose()?.unwrap_or_default();
    let known_lines = record.lines_for(&job.lipz_file);
    let settings_with = |grid: Option<&Grid>| settings_hash(options, locale, &script, rate, grid);
    // One from which a mouth of this recording was made is as long; of others, somebody has to look.
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
    let made = Made {
        sound,
        text: text_hash(spoken_text),
        settings: settings_with(grid.as_ref()),
        mouth: mouth_hash(&clip.codes, own_fps.or(options.options.get_default_fps()), own_type),
    };
    let known = known_lines.iter().map(|line| line.renewed(spoken_text)).collect();
    let of_original = spoken_in_original(job, original.as_ref(), options);
    let recorded = record.spoken_now(&job.lipz_file, sound, spoken_text, of_original);
    let (original, original_file) = (original.as_ref(), (&*original_file.0, &*original_file.1));
    let (name, bytes, before) = (&*name, &*bytes, &before);
    let subject = Subject {
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
    work(subject, reports)
}

/// The content hash of a recording.
pub(crate) fn hash_of(recording: &Path) -> Result<u64, Report> {
    File::open(recording).and_then(content_hash).map_err(|error| unreadable(recording, &error))
}

/// The Lipz file of the original of a dub: its name, and its bytes; empty if there is none.
fn original_file(job: &Job, place: &dyn Place) -> (String, Vec<u8>) {
    let Some(original) = &job.original else { return Default::default() };
    (shown(&original.lipz_file), place.read(&original.lipz_file).unwrap_or_default())
}

/// Whether the Lipz file of a job is not there yet, and its bytes; for a new one, what it will be without a mouth.
pub(super) fn text_file(
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

/// The words of the text that is spoken in a locale. Reports what is odd about it.
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

/// Reports what was found in a Lipz file, at the project's levels; whether it is an error.
pub(super) fn push(
    reports: &mut Vec<Report>,
    options: &SyncOptions,
    name: &str,
    bytes: &[u8],
    mut diagnostics: Vec<Diagnostic>,
) -> bool {
    options.options.levels_for(name).apply(&mut diagnostics);
    let has_errors = diagnostics.iter().any(Diagnostic::is_error);
    diagnostics.sort_by_key(Diagnostic::start);
    if !diagnostics.is_empty() {
        reports.push(Report::from_bytes(name, bytes, diagnostics));
    }
    has_errors
}

/// Reports what was found elsewhere, at the project's levels.
pub(super) fn push_report(reports: &mut Vec<Report>, options: &SyncOptions, report: Option<Report>) {
    reports.extend(report.map(|mut report| {
        options.options.apply_levels(&mut report);
        report
    }));
}

/// A file that is not there yet: what is said.
fn new_document(job: &Job, options: &SyncOptions) -> Document<'static> {
    let string = |text: String| JsonString::from(Cow::Owned(text));
    let element =
        |text: &String| Element { name: string(options.text_element(job)), value: Value::String(string(text.clone())) };
    Document { elements: job.text.iter().map(element).collect() }
}

fn own_type(document: &Document<'_>) -> Option<VisemeType> {
    string(document, "viseme_type").and_then(|name| name.text.parse().ok())
}

/// Reports a text of the script that is not the one of the file, which stays.
fn other_text(job: &Job, spoken: Option<&JsonString<'_>>) -> Option<Diagnostic> {
    let text = job.text.as_ref()?;
    let Some(spoken) = spoken else {
        return Some(
            Diagnostic::new(Code::OtherText, "the file has no text, but the script has one").help("add it to the file"),
        );
    };
    let is_same = words(text).eq(words(&spoken.text));
    let message = format!("the script has another text: {}", escape::quoted(text));
    (!is_same).then(|| {
        Diagnostic::at(Code::OtherText, spoken.span(), message)
            .note("the text of the Lipz file counts: writers and translators work there")
            .help("bring the two together")
    })
}
