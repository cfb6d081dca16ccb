//! Creation of jobs from recordings, Lipz files and scripts. A job is a recording, and the Lipz file that gets its
//! visemes.

use crate::job::SyncOptions;
use crate::job::text_files::TextFiles;
use crate::recordings::file_facts::{no_sound, unreadable};
use crate::recordings::finder::not_used;
use crate::recordings::originals::{Originals, beside};
use crate::recordings::paths::{shown, slashed};
use crate::recordings::places::RecordingPlaces;
use crate::recordings::{FileFacts, Recordings, is_recording};
use lipz_compiler::settings::Settings;
use lipz_compiler::{Content, Input, key};
use lipz_diagnostics::{Code, Diagnostic, Report, escape};
use lipz_interop::Script;
use lipz_speech::SoundError;
use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};
use std::fs;
use std::path::{Path, PathBuf};

/// A lip-sync track to be made.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Job {
    /// The key of the clip.
    pub key: String,
    /// The recording.
    pub recording: PathBuf,
    /// The Lipz file, which may not exist yet.
    pub lipz_file: PathBuf,
    /// The transcript, for a file that does not exist yet.
    pub text: Option<String>,
    /// The spoken locale; `None` for that of the [`SyncOptions`].
    pub locale: Option<String>,
    /// The original, if the clip is a dub. A dub without a text uses that of the original.
    pub original: Option<Original>,
}

/// The original of a dub.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Original {
    /// Its Lipz file.
    pub lipz_file: PathBuf,
    /// Its recording, if it exists.
    pub recording: Option<PathBuf>,
    /// Its spoken locale; `None` for that of the [`SyncOptions`].
    pub locale: Option<String>,
}

/// Returns the jobs for Lipz files with a recording, and for recordings of dubs that will become new Lipz files, if
/// their originals are among these files. Clips without a recording have no job.
pub fn jobs_of_clips(inputs: &[Input], recordings: &Recordings) -> Vec<Job> {
    let voices = recordings.voices();
    let originals = Originals::new(voices, inputs);
    let job = |key: &str, lipz_file: PathBuf| {
        let original = originals.of(key, &lipz_file).and_then(|input| Original::new(&input, recordings));
        let (key, recording) = (key.to_owned(), recordings.find(key)?.to_owned());
        let locale = recordings.locale(&key).map(str::to_owned);
        Some(Job { key, recording, lipz_file, text: None, locale, original })
    };
    let mut jobs: Vec<Job> = inputs.iter().filter_map(|input| job(&input.key, file(input)?.to_owned())).collect();
    let mut is_new = HashSet::new();
    for input in inputs {
        for locale in voices.patterns.keys().filter(|locale| Some(*locale) != voices.original.as_ref()) {
            let Some(dub) = voices.dub_of(&input.key, locale).filter(|dub| !originals.has(dub)) else { continue };
            let is_dub_of_it = voices.original_of(&dub, |key| key == input.key).is_some();
            let lipz_file = file(input).filter(|_| is_dub_of_it).and_then(|path| beside(path, &input.key, &dub));
            if let Some(lipz_file) = lipz_file.filter(|_| key::refusal(&dub).is_none() && is_new.insert(dub.clone())) {
                jobs.extend(job(&dub, lipz_file));
            }
        }
    }
    jobs
}

impl Original {
    /// Returns the clip in this file.
    fn new(input: &Input, recordings: &Recordings) -> Option<Original> {
        Some(Original {
            lipz_file: file(input)?.to_owned(),
            recording: recordings.find(&input.key).map(Path::to_owned),
            locale: recordings.locale(&input.key).map(str::to_owned),
        })
    }
}

fn file(input: &Input) -> Option<&Path> {
    match &input.content {
        Content::File(path) => Some(path),
        Content::Bytes { .. } => None,
    }
}

/// Returns the jobs for recordings. The sources of the settings are files and folders of recordings. Each becomes a
/// Lipz file in `output`, under its path below the root of the settings if it is there, otherwise below its source. Its
/// transcript is in `script` under the name of the file, or next to it in `NAME.txt`.
///
/// Reports files that cannot be read or used, and lines of the script without a recording. For tools that report
/// everything at once, such as the command `lipz`. All other programs call
/// [`SyncRun::of_recordings`](crate::SyncRun::of_recordings).
#[must_use = "check the reports for missing recordings"]
pub fn jobs_of_recordings_with_reports(
    settings: &Settings,
    output: &Path,
    script: Option<&Script>,
) -> (Vec<Job>, Vec<Report>) {
    let (mut found, mut reports) = (Vec::new(), Vec::new());
    for source in &settings.sources {
        if source.is_file() {
            let stem = source.file_stem().and_then(|stem| stem.to_str());
            match stem.filter(|_| is_recording(source)) {
                Some(stem) => found.push((stem.to_owned(), source.clone())),
                None => {
                    let message = format!("`{}` does not have the extension of a recording", shown(source));
                    let help =
                        format!("name files that end in {}", lipz_compiler::settings::SOUND_EXTENSIONS.join(", "));
                    reports.push(Report::failure(shown(source), Code::UnreadableSound, message, &help));
                }
            }
            continue;
        }
        let (recordings, unread) = Recordings::below_with_reports(source);
        if unread.is_empty() && recordings.iter().next().is_none() {
            let message = format!("no recordings in `{}`", shown(source));
            let help = format!("add recordings, which end in {}", lipz_compiler::settings::SOUND_EXTENSIONS.join(", "));
            reports.push(Report::failure(shown(source), Code::NoSources, message, &help));
        }
        reports.extend(unread);
        reports.extend(not_used(&recordings));
        let why = |path: &Path| FileFacts::read(path).err();
        let unknown = |path: &Path| no_sound(path, &SoundError::OtherFormat { name: None });
        reports.extend(recordings.unread().map(|path| why(path).unwrap_or_else(|| unknown(path))));
        found.extend(recordings.iter().map(|(name, path)| (name.to_owned(), path.to_owned())));
    }
    if let Some(root) = &settings.root {
        for (key, path) in &mut found {
            let below = path.strip_prefix(root).ok().and_then(|below| slashed(&below.with_extension("")));
            *key = below.unwrap_or_else(|| std::mem::take(key));
        }
    }
    found.sort();
    found.dedup();
    let inputs: Vec<Input> =
        found.iter().map(|(key, path)| Input { key: key.clone(), content: Content::File(path.clone()) }).collect();
    key::check(&inputs, &mut reports);
    let mut times = HashMap::<String, usize>::new();
    found.iter().for_each(|(key, _)| *times.entry(key::folded(key)).or_default() += 1);
    let is_usable = |key: &str| key::refusal(key).is_none() && times.get(&key::folded(key)) == Some(&1);
    let places = RecordingPlaces::new(settings);
    let (mut jobs, mut texts) = (Vec::new(), TextFiles::default());
    for (key, recording) in found.into_iter().filter(|(key, _)| is_usable(key)) {
        let lipz_file = output.join(format!("{key}.{}", key::EXTENSION));
        match text_of(&key, &recording, script, &mut texts) {
            Ok(text) => {
                let locale = places.voice_of(&key).and_then(|place| place.locale).map(str::to_owned);
                jobs.push(Job { key, recording, lipz_file, text, locale, original: None });
            }
            Err(report) => reports.push(report),
        }
    }
    add_originals(&mut jobs, &places);
    // If only some files of a folder are named, its other files also count as recorded.
    let named = settings.sources.iter().filter(|source| source.is_file()).filter_map(|source| source.parent());
    let beside: Vec<PathBuf> = named.collect::<BTreeSet<_>>().into_iter().flat_map(recordings_in).collect();
    reports.extend(script.and_then(|script| script_without_recording(script, &jobs, &beside)));
    reports.extend(texts_without_recording(&jobs, &mut texts));
    (jobs, reports)
}

/// Sets the originals of dubs: clips of these jobs, or clips whose files exist.
fn add_originals(jobs: &mut [Job], places: &RecordingPlaces) {
    let input = |job: &Job| Input { key: job.key.clone(), content: Content::File(job.lipz_file.clone()) };
    let inputs: Vec<Input> = jobs.iter().map(input).collect();
    let recordings: HashMap<String, PathBuf> =
        jobs.iter().map(|job| (job.key.clone(), job.recording.clone())).collect();
    let originals = Originals::new(&places.voices, &inputs);
    for job in jobs {
        let Some(original) = originals.of(&job.key, &job.lipz_file) else { continue };
        job.original = file(&original).map(|lipz_file| Original {
            lipz_file: lipz_file.to_owned(),
            recording: recordings.get(&original.key).cloned(),
            locale: places.of(&original.key).locale.map(str::to_owned),
        });
    }
}

/// Returns the transcript of a recording, from the script or the text file next to it.
fn text_of(
    key: &str,
    recording: &Path,
    script: Option<&Script>,
    texts: &mut TextFiles,
) -> Result<Option<String>, Report> {
    if let Some(text) = script.and_then(|script| script.text_of_file(recording, key)) {
        return Ok(Some(text.to_owned()));
    }
    let Some(path) = texts.beside(recording) else { return Ok(None) };
    let bytes = fs::read(&path).map_err(|error| unreadable(&path, &error))?;
    let mut diagnostics = Vec::new();
    match lipz_file::decode(lipz_file::without_byte_order_mark(&bytes), &mut diagnostics) {
        Some(text) => Ok(Some(lipz_file::text::trim(text).to_owned())),
        None => Err(Report::from_bytes(shown(&path), &bytes, diagnostics)),
    }
}

/// Returns the recordings directly in this folder.
fn recordings_in(folder: &Path) -> Vec<PathBuf> {
    let here = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let files = fs::read_dir(here).into_iter().flatten().flatten().map(|entry| folder.join(entry.file_name()));
    files.filter(|path| is_recording(path)).collect()
}

/// Reports lines of a script without a recording, neither in a job nor in `beside`.
fn script_without_recording(script: &Script, jobs: &[Job], beside: &[PathBuf]) -> Option<Report> {
    let of_jobs = jobs.iter().map(|job| (job.recording.as_path(), job.key.as_str()));
    let name = |path: &PathBuf| path.file_stem().and_then(|stem| stem.to_str()).unwrap_or_default().to_owned();
    let names: Vec<String> = beside.iter().map(name).collect();
    let others = beside.iter().map(PathBuf::as_path).zip(names.iter().map(String::as_str));
    let lines = script.names_without(of_jobs.chain(others));
    let message = |first: &str| format!("the script has a text for `{first}`, which was not recorded");
    let diagnostic = without_recording(&lines, message)?;
    Some(Report::about(script.path(), diagnostic.help("add the recordings, or remove the lines")))
}

/// Reports text files without a recording, in folders where other text files have one.
fn texts_without_recording(jobs: &[Job], files: &mut TextFiles) -> Vec<Report> {
    let mut folders = BTreeMap::<&Path, BTreeSet<PathBuf>>::new();
    for job in jobs {
        let texts = folders.entry(job.recording.parent().unwrap_or(Path::new(""))).or_default();
        texts.extend(files.beside(&job.recording));
    }
    let mut reports = Vec::new();
    for (folder, of_recordings) in folders.into_iter().filter(|(_, texts)| texts.iter().any(|text| text.is_file())) {
        let here = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
        let files = fs::read_dir(here).into_iter().flatten().flatten().map(|entry| folder.join(entry.file_name()));
        let is_text = |path: &PathBuf| path.extension().is_some_and(|extension| extension == "txt") && path.is_file();
        let is_recorded = |path: &PathBuf| {
            let mut extensions = lipz_compiler::settings::SOUND_EXTENSIONS.iter();
            of_recordings.contains(path) || extensions.any(|extension| path.with_extension(extension).is_file())
        };
        let mut lonely: Vec<String> =
            files.filter(|path| is_text(path) && !is_recorded(path)).map(|path| shown(&path)).collect();
        lonely.sort();
        let lonely: Vec<&str> = lonely.iter().map(String::as_str).collect();
        let diagnostic = without_recording(&lonely, |first| format!("the text `{first}` has no recording"));
        let help = "record the line, or move the text file to a different folder";
        reports.extend(diagnostic.map(|diagnostic| Report::about(shown(folder), diagnostic.help(help))));
    }
    reports
}

/// Returns a diagnostic about these texts. The first is in its message.
fn without_recording(names: &[&str], message: impl FnOnce(&str) -> String) -> Option<Diagnostic> {
    let (first, others) = names.split_first()?;
    let more = if others.is_empty() { String::new() } else { format!(", and {} more", others.len()) };
    let diagnostic = Diagnostic::new(Code::ScriptWithoutRecording, message(&escape::text(first)) + &more);
    Some(others.iter().take(9).fold(diagnostic, |diagnostic, name| diagnostic.note(format!("`{name}`"))))
}

impl SyncOptions {
    /// Returns the name of the element for the text of a new file.
    pub(crate) fn text_element(&self, job: &Job) -> String {
        self.locale_of(job).map_or_else(|| "text".to_owned(), |locale| format!("text_{locale}"))
    }
}
