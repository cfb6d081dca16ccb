//! The projects of open files, and the results of their checks.

use crate::words::Words;
use lipz_compiler::settings::Settings;
use lipz_compiler::{Compiler, Content, Input};
use lipz_diagnostics::{Diagnostic, Report};
use lipz_sync::Recordings;
use std::collections::{BTreeMap, HashMap};
use std::path::{Path, PathBuf};

/// A project: its settings and their file.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct Project {
    /// The settings. All paths are absolute.
    pub settings: Settings,
    /// The settings file; `None` for files without a project.
    pub file: Option<PathBuf>,
}

/// The result of checking a project.
#[derive(Clone, Debug, Default)]
pub struct CheckedProject {
    /// Its Lipz files, with their keys.
    pub inputs: Vec<Input>,
    /// The diagnostics of these files, and of the rest of the project.
    pub reports: Vec<Report>,
}

/// The cached state of a project.
#[derive(Debug, Default)]
pub(crate) struct KnownProject {
    pub(crate) project: Project,
    /// The diagnostics of its settings file.
    pub(crate) settings_report: Option<Report>,
    /// The bytes of its settings file.
    settings_bytes: Vec<u8>,
    /// Whether its files and recordings have been discovered.
    is_discovered: bool,
    /// The keys of its clips, by file path.
    pub(crate) keys: HashMap<PathBuf, String>,
    /// The words of its events and texts.
    pub(crate) words: Words,
    pub(crate) recordings: Recordings,
    /// The diagnostics of the last check, by path.
    pub(crate) diagnostics: BTreeMap<String, Report>,
}

impl KnownProject {
    /// Returns the project of a file below one of the editor's open folders.
    pub(crate) fn of(path: Option<&Path>, folders: &[PathBuf]) -> KnownProject {
        let Some(path) = path else { return KnownProject::default() };
        match path.parent().and_then(Settings::find) {
            Some(file) => KnownProject::from_settings(file),
            None => {
                let folder = folders.iter().find(|folder| path.starts_with(folder));
                let sources = vec![folder.map_or(path, PathBuf::as_path).to_owned()];
                let project = Project { settings: Settings::from_sources(sources), file: None };
                KnownProject { project, ..KnownProject::default() }
            }
        }
    }

    fn from_settings(file: PathBuf) -> KnownProject {
        // Read before the settings are parsed, so that a later change is detected next time.
        let settings_bytes = std::fs::read(&file).unwrap_or_default();
        let (settings, report) = Settings::read_with_report(&file);
        let settings_report = (!report.diagnostics.is_empty()).then_some(report);
        let project = Project { settings, file: Some(file) };
        KnownProject { project, settings_report, settings_bytes, ..KnownProject::default() }
    }

    /// Reads the settings again if their file has changed. Returns whether it has.
    pub(crate) fn follow_settings(&mut self) -> bool {
        let Some(file) = &self.project.file else { return false };
        if std::fs::read(file).is_ok_and(|bytes| bytes == self.settings_bytes) {
            return false;
        }
        let KnownProject { project, settings_report, settings_bytes, .. } = KnownProject::from_settings(file.clone());
        (self.project, self.settings_report, self.settings_bytes) = (project, settings_report, settings_bytes);
        true
    }

    /// Stores the Lipz files and the recordings of the project.
    pub(crate) fn discovered(&mut self, inputs: Vec<Input>, recordings: Recordings) {
        let files = inputs.into_iter().map(|input| match input.content {
            Content::File(path) => (path, input.key),
            Content::Bytes { name, .. } => (PathBuf::from(name), input.key),
        });
        self.keys = files.collect();
        self.recordings = recordings;
        self.is_discovered = true;
    }

    /// Discovers the files and recordings, unless this has been done.
    pub(crate) fn discover(&mut self) {
        if !self.is_discovered {
            let settings = &self.project.settings;
            // Missing files are reported by the check.
            let (inputs, _) = settings.discover_with_reports();
            let (recordings, _) = Recordings::discover_with_reports(settings);
            self.discovered(inputs, recordings);
        }
    }

    /// Returns the path that identifies this project.
    pub(crate) fn id(&self) -> PathBuf {
        let first = || self.project.settings.sources.first().cloned();
        self.project.file.clone().or_else(first).unwrap_or_default()
    }

    /// Returns the key of the clip in a file: the one in the project, or the file's own name.
    pub(crate) fn key(&self, path: Option<&Path>) -> String {
        let stem = || path?.file_stem()?.to_str().map(str::to_owned);
        path.and_then(|path| self.keys.get(path).cloned()).or_else(stem).unwrap_or_else(|| "untitled".to_owned())
    }

    /// Calls a function with the bytes of every Lipz file of the project. For open files, these come from the editor.
    pub(crate) fn each_file<R: Send>(
        &self,
        unsaved: &HashMap<String, String>,
        work: impl Fn(&str, &[u8]) -> R + Send + Sync,
    ) -> Vec<R> {
        let (inputs, _) = self.project.settings.discover_with_reports();
        each_file(&self.project, &inputs, unsaved, work)
    }
}

/// Calls a function with the bytes of these files. For open files, these come from the editor.
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
    // Unreadable files are reported by the check.
    results.into_iter().filter_map(Result::ok).collect()
}

/// Returns the diagnostics that are in `all` but not in `some`.
pub(crate) fn without(all: &[Diagnostic], some: &[Diagnostic]) -> Vec<Diagnostic> {
    all.iter().filter(|diagnostic| !some.contains(diagnostic)).cloned().collect()
}
