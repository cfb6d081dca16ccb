//! From recordings, Lipz files and scripts to jobs: a recording, and the Lipz file whose mouth it becomes.

use super::SyncOptions;
use crate::Recordings;
use crate::facts::unreadable;
use crate::recordings::{is_recording, shown};
use lipz_compiler::{Content, Input, key};
use lipz_diagnostics::{Code, Diagnostic, Report};
use lipz_interop::Script;
use std::collections::{HashMap, HashSet};
use std::fs;
use std::path::{Path, PathBuf};

/// One mouth to be made.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Job {
    /// The key of the clip.
    pub key: String,
    /// The recording.
    pub recording: PathBuf,
    /// The Lipz file, which may not be there yet.
    pub lipz_file: PathBuf,
    /// What is said, for a file that is not there yet.
    pub text: Option<String>,
}

/// The jobs for Lipz files that have a recording. Clips without one have none.
pub fn jobs_of_clips(inputs: &[Input], recordings: &Recordings) -> Vec<Job> {
    let job = |input: &Input| {
        let Content::File(lipz_file) = &input.content else { return None };
        let recording = recordings.find(&input.key)?.to_owned();
        Some(Job { key: input.key.clone(), recording, lipz_file: lipz_file.clone(), text: None })
    };
    inputs.iter().filter_map(job).collect()
}

/// The jobs for recordings: `sources` are files and folders of them, each becomes a Lipz file in `output` under its path
/// below its source. What is said stands in `script`, under the name of the file, or beside it in `NAME.txt`.
///
/// Reports what cannot be read or used, and lines of the script that have no recording.
pub fn jobs_of_recordings(sources: &[PathBuf], output: &Path, script: Option<&Script>) -> (Vec<Job>, Vec<Report>) {
    let (mut found, mut reports) = (Vec::new(), Vec::new());
    for source in sources {
        if source.is_file() {
            let stem = source.file_stem().and_then(|stem| stem.to_str());
            match stem.filter(|_| is_recording(source)) {
                Some(stem) => found.push((stem.to_owned(), source.clone())),
                None => {
                    let message = format!("`{}` has no extension of a sound", shown(source));
                    let help = format!("the extensions are {}", crate::EXTENSIONS.join(", "));
                    reports.push(Report::failure(shown(source), Code::UnreadableSound, message, &help));
                }
            }
            continue;
        }
        let (recordings, unread) = Recordings::below(source, None);
        if unread.is_empty() && recordings.iter().next().is_none() {
            let message = format!("no recordings in `{}`", shown(source));
            let help = format!("recordings end in {}", crate::EXTENSIONS.join(", "));
            reports.push(Report::failure(shown(source), Code::NoSources, message, &help));
        }
        reports.extend(unread);
        found.extend(recordings.iter().map(|(name, path)| (name.to_owned(), path.to_owned())));
    }
    found.sort();
    found.dedup();
    let inputs: Vec<Input> =
        found.iter().map(|(key, path)| Input { key: key.clone(), content: Content::File(path.clone()) }).collect();
    key::check(&inputs, &mut reports);
    let mut times = HashMap::<String, usize>::new();
    found.iter().for_each(|(key, _)| *times.entry(key::folded(key)).or_default() += 1);
    let is_usable = |key: &str| key::refusal(key).is_none() && times.get(&key::folded(key)) == Some(&1);
    let mut jobs = Vec::new();
    for (key, recording) in found.into_iter().filter(|(key, _)| is_usable(key)) {
        let lipz_file = output.join(format!("{key}.{}", key::EXTENSION));
        match text_of(&recording, script) {
            Ok(text) => jobs.push(Job { key, recording, lipz_file, text }),
            Err(report) => reports.push(report),
        }
    }
    if let Some(script) = script {
        reports.extend(without_recording(script, &jobs));
    }
    (jobs, reports)
}

/// What is said in a recording: by the script, or by the text file beside it.
fn text_of(recording: &Path, script: Option<&Script>) -> Result<Option<String>, Report> {
    let stem = recording.file_stem().and_then(|stem| stem.to_str()).unwrap_or_default();
    if let Some(text) = script.and_then(|script| script.text_of(stem)) {
        return Ok(Some(text.to_owned()));
    }
    let path = recording.with_extension("txt");
    if !path.is_file() {
        return Ok(None);
    }
    let bytes = fs::read(&path).map_err(|error| unreadable(&path, &error))?;
    let mut diagnostics = Vec::new();
    match lipz_file::decode(lipz_file::without_byte_order_mark(&bytes), &mut diagnostics) {
        Some(text) => Ok(Some(lipz_file::text::trim(text).to_owned())),
        None => Err(Report::from_bytes(shown(&path), &bytes, diagnostics)),
    }
}

/// Lines of a script that belong to no recording.
fn without_recording(script: &Script, jobs: &[Job]) -> Option<Report> {
    let stem = |job: &Job| Some(job.recording.file_stem()?.to_str()?.to_lowercase());
    let recorded: HashSet<String> = jobs.iter().filter_map(stem).collect();
    let lines: Vec<&str> = script.names().filter(|name| !recorded.contains(*name)).collect();
    let (first, others) = lines.split_first()?;
    let more = if others.is_empty() { String::new() } else { format!(", and {} more", others.len()) };
    let message = format!("the script has a text for `{first}`, which was not recorded{more}");
    let diagnostic = Diagnostic::new(Code::ScriptWithoutRecording, message);
    let diagnostic =
        lines.iter().skip(1).take(9).fold(diagnostic, |diagnostic, line| diagnostic.note(format!("`{line}`")));
    Some(Report::about("", diagnostic.help("add the recordings, or remove the lines")))
}

impl SyncOptions {
    /// The name of the element for the text of a new file.
    pub(crate) fn text_element(&self) -> String {
        self.locale.as_ref().map_or_else(|| "text".to_owned(), |locale| format!("text_{locale}"))
    }
}
