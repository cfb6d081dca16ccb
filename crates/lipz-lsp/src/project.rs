//! The projects that open files belong to, and what their check found.

use crate::words::Words;
use lipz_compiler::settings::Settings;
use lipz_compiler::{Compiler, Content, Input};
use lipz_diagnostics::{Diagnostic, Report};
use lipz_sync::Recordings;
use std::collections::{BTreeMap, HashMap};
use std::path::{Path, PathBuf};

/// A project: its settings, and where they come from.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct Project {
    /// The settings. All paths are absolute.
    pub settings: Settings,
    /// The file that they come from; `None` for files without a project.
    pub file: Option<PathBuf>,
}

/// What the check of a project gave.
#[derive(Clone, Debug, Default)]
pub struct Checked {
    /// Its Lipz files, with their keys.
    pub inputs: Vec<Input>,
    /// What is wrong with them, and with whatever else the project has.
    pub reports: Vec<Report>,
}

/// A project as far as it is known.
#[derive(Debug, Default)]
pub(crate) struct Known {
    pub(crate) project: Project,
    /// What is wrong with its settings file.
    pub(crate) settings_report: Option<Report>,
    /// The bytes of that file.
    settings_bytes: Vec<u8>,
    /// Whether its files and recordings were looked for.
    is_discovered: bool,
    /// The keys of its clips, by the paths of their files.
    pub(crate) keys: HashMap<PathBuf, String>,
    /// What its events and texts are made of.
    pub(crate) words: Words,
    pub(crate) recordings: Recordings,
    /// The diagnostics of the last check, by path.
    pub(crate) diagnostics: BTreeMap<String, Report>,
}

impl Known {
    /// The project of a file below one of the folders that the editor has open.
    pub(crate) fn of(path: Option<&Path>, folders: &[PathBuf]) -> Known {
        let Some(path) = path else { return Known::default() };
        match path.parent().and_then(Settings::find) {
            Some(file) => Known::from_settings(file),
            None => {
                let folder = folders.iter().find(|folder| path.starts_with(folder));
                let sources = vec![folder.map_or(path, PathBuf::as_path).to_owned()];
                let project = Project { settings: Settings::from_sources(sources), file: None };
                Known { project, ..Known::default() }
            }
        }
    }

    fn from_settings(file: PathBuf) -> Known {
        // Before they are read: what changes in between is noticed next time.
        let settings_bytes = std::fs::read(&file).unwrap_or_default();
        let (settings, report) = Settings::read_with_report(&file);
        let settings_report = (!report.diagnostics.is_empty()).then_some(report);
        let project = Project { settings, file: Some(file) };
        Known { project, settings_report, settings_bytes, ..Known::default() }
    }

    /// Reads the settings again if their file has changed; whether it has.
    pub(crate) fn follow_settings(&mut self) -> bool {
        let Some(file) = &self.project.file else { return false };
        if std::fs::read(file).is_ok_and(|bytes| bytes == self.settings_bytes) {
            return false;
        }
        let Known { project, settings_report, settings_bytes, .. } = Known::from_settings(file.clone());
        (self.project, self.settings_report, self.settings_bytes) = (project, settings_report, settings_bytes);
        true
    }

    /// Takes note of the Lipz files and the recordings of the project.
    pub(crate) fn discovered(&mut self, inputs: Vec<Input>, recordings: Recordings) {
        let files = inputs.into_iter().map(|input| match input.content {
            Content::File(path) => (path, input.key),
            Content::Bytes { name, .. } => (PathBuf::from(name), input.key),
        });
        self.keys = files.collect();
        self.recordings = recordings;
        self.is_discovered = true;
    }

    /// Looks for them, if that has not been done.
    pub(crate) fn discover(&mut self) {
        if !self.is_discovered {
            let settings = &self.project.settings;
            // What is missing is reported by the check.
            let (inputs, _) = settings.discover_with_reports();
            let (recordings, _) = Recordings::discover_with_reports(settings);
            self.discovered(inputs, recordings);
        }
    }

    /// What tells this project from others.
    pub(crate) fn id(&self) -> PathBuf {
        let first = || self.project.settings.sources.first().cloned();
        self.project.file.clone().or_else(first).unwrap_or_default()
    }

    /// The key of the clip in a file: that of the project, or the file's own name.
    pub(crate) fn key(&self, path: Option<&Path>) -> String {
        let stem = || path?.file_stem()?.to_str().map(str::to_owned);
        path.and_then(|path| self.keys.get(path).cloned()).or_else(stem).unwrap_or_else(|| "untitled".to_owned())
    }

    /// The bytes of all Lipz files of the project, those that are open as they are in the editor.
    pub(crate) fn each_file<R: Send>(
        &self,
        unsaved: &HashMap<String, String>,
        work: impl Fn(&str, &[u8]) -> R + Send + Sync,
    ) -> Vec<R> {
        let (inputs, _) = self.project.settings.discover_with_reports();
        each_file(&self.project, &inputs, unsaved, work)
    }
}

/// The bytes of these files, those that are open as they are in the editor.
pub(crate) fn each_file<R: Send>(
    project: &Project,
    inputs: &[Input],
    unsaved: &HashMap<String, String>,
    work: impl Fn(&str, &[u8]) -> R + Send + Sync,
) -> Vec<R> {
    let results = Compiler::new(project.settings.options.clone()).each_file(inputs, |input, bytes| {
        let name = input.name();
        let bytes = unsaved.get(&name).map_or(bytes, String::as_bytes);
        work(&name, bytes)
    });
    // A file that cannot be read is reported by the check.
    results.into_iter().filter_map(Result::ok).collect()
}

/// The diagnostics that are in `all` and not in `some`.
pub(crate) fn without(all: &[Diagnostic], some: &[Diagnostic]) -> Vec<Diagnostic> {
    all.iter().filter(|diagnostic| !some.contains(diagnostic)).cloned().collect()
}
