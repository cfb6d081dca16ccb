//! The settings file of a project: its path, its contents, and its name in messages.

use crate::Abort;
use crate::Outcome;
use crate::reporter::Reporter;
use crate::shared::sources::PROJECT;
use crate::shared::stdio;
use clap::{ArgAction, Args};
use lipz_compiler::settings::{FILE_NAME, Settings};
use lipz_diagnostics::Code;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

/// The settings file of a run, and the settings that override it.
#[derive(Args, Debug)]
pub(crate) struct SettingsFile {
    /// Settings file, or one setting: text.lines=2
    ///
    /// By default, the file is the lipz.toml next to or above the first source, or else that of the current folder. Repeat
    /// the option to override several settings of the file. `lipz print settings` lists all settings.
    #[arg(long, value_name = "FILE|KEY=VALUE", action = ArgAction::Append, help_heading = PROJECT)]
    config: Vec<OsString>,

    /// Ignore lipz.toml
    #[arg(long, help_heading = PROJECT)]
    no_config: bool,
}

/// The name of the command line's settings in messages.
const CONFIG: &str = "--config";

/// The input of a run: the settings file, overridden by the command line's arguments.
pub(crate) struct Project {
    /// The settings.
    pub(crate) settings: Settings,
    /// The path of the settings file.
    pub(crate) file: Option<PathBuf>,
    /// Whether the command line names the file.
    is_named: bool,
    /// The sources that the command line names.
    own_sources: Vec<PathBuf>,
}

impl Project {
    /// Creates a project from settings that an editor has found.
    pub(crate) fn found_by_editor(settings: Settings, file: Option<PathBuf>) -> Project {
        Project { settings, file, is_named: false, own_sources: Vec::new() }
    }

    /// Returns the settings file, if it is not in the current folder.
    pub(crate) fn found(&self) -> Option<&Path> {
        self.file.as_deref().filter(|file| !self.is_named && *file != Path::new(FILE_NAME))
    }

    /// Sets the keys of files from the command line to those that they have in the whole project.
    pub(crate) fn keep_keys(&mut self) {
        let real = |path: &PathBuf| {
            let there = path.ancestors().find(|path| path.exists()).filter(|path| !path.as_os_str().is_empty());
            there.unwrap_or(Path::new(".")).canonicalize().ok()
        };
        let named: Option<Vec<PathBuf>> = self.settings.sources.iter().map(real).collect();
        let is_above = |source: &&PathBuf| {
            let folder = real(source);
            folder.zip(named.as_ref()).is_some_and(|(folder, named)| named.iter().all(|path| path.starts_with(&folder)))
        };
        let above = || self.own_sources.iter().find(|source| source.is_dir() && is_above(source)).cloned();
        self.settings.root = self.settings.root.take().or_else(above);
    }
}

impl SettingsFile {
    /// Returns the project of these sources, or of its settings file if there are none. Reports its problems.
    pub(crate) fn project(&self, sources: &[PathBuf], reporter: &mut Reporter) -> Result<Project, Abort> {
        let (files, assignments) = self.config();
        if files.len() + usize::from(self.no_config) > 1 {
            let tip = "name one settings file; settings have the form KEY=VALUE: --config text.lines=2";
            return Err(
                reporter.usage("`--config` names a second settings file, or one that `--no-config` ignores", tip)
            );
        }
        let file = self.find(sources);
        let mut settings = match &file {
            Some(file) => read(file, reporter)?,
            None => Settings::default(),
        };
        let warnings = settings.assign(assignments, CONFIG).map_err(|report| reporter.fail(report))?;
        reporter.add(warnings);
        if let Some(file) = stdio::name() {
            // The file has the same key as in the project.
            let source = settings.sources.iter().find(|source| file.starts_with(source));
            settings.root = settings.root.take().or_else(|| source.cloned());
        }
        let own_sources = settings.sources.clone();
        if !sources.is_empty() {
            settings.sources = sources.to_vec();
        }
        if settings.sources.is_empty() {
            let tip = format!("name a folder of Lipz files, or create a {FILE_NAME} with `lipz init`");
            return Err(reporter.usage(
                format!("no sources are named, and neither this folder nor one above it has a {FILE_NAME}"),
                &tip,
            ));
        }
        Ok(Project { settings, file, is_named: !files.is_empty(), own_sources })
    }

    /// Returns the settings file that applies, or would apply if it were created in the current folder; `None` if the
    /// arguments exclude it.
    pub(crate) fn place(&self, sources: &[PathBuf]) -> Option<PathBuf> {
        let file = || self.find(sources).unwrap_or_else(|| FILE_NAME.into());
        (!self.no_config).then(file)
    }

    /// Returns the settings file that the arguments name, or else that of the sources.
    fn find(&self, sources: &[PathBuf]) -> Option<PathBuf> {
        if self.no_config {
            return None;
        }
        // Standard input counts as being in the folder of its file.
        let place = |source: &PathBuf| match stdio::name() {
            Some(file) if stdio::is_meant(source) => file,
            _ => source.clone(),
        };
        let places: Vec<PathBuf> = sources.iter().map(place).collect();
        self.config().0.into_iter().next().or_else(|| Settings::find_of(&places))
    }

    /// Returns the settings files and the settings of `--config`. A value with `=` is a setting, unless a file has that
    /// name.
    fn config(&self) -> (Vec<PathBuf>, Vec<&str>) {
        let is_assignment =
            |value: &&OsString| value.to_str().is_some_and(|text| text.contains('=')) && !Path::new(value).exists();
        let (assignments, files): (Vec<_>, Vec<_>) = self.config.iter().partition(is_assignment);
        let assignments = assignments.into_iter().filter_map(|value| value.to_str()).collect();
        (files.into_iter().map(PathBuf::from).collect(), assignments)
    }

    /// Returns the names of the settings that the command line sets.
    pub(crate) fn assigned(&self) -> Vec<&str> {
        let assignments = self.config().1.into_iter();
        assignments.map(|text| text.split_once('=').map_or(text, |(key, _)| key).trim()).collect()
    }

    /// Whether the command line names settings.
    pub(crate) fn is_used(&self) -> bool {
        !self.config.is_empty()
    }
}

/// Reads the settings in `file`, and prints their diagnostics.
fn read(file: &Path, reporter: &mut Reporter) -> Result<Settings, Abort> {
    let (settings, report) = Settings::read_with_report(file);
    let has_errors = report.has_errors();
    let is_read = report.diagnostics.iter().all(|diagnostic| diagnostic.code != Code::SettingsUnreadable);
    let found = if report.diagnostics.is_empty() { Vec::new() } else { vec![report] };
    if has_errors {
        return Err(reporter.abort(found, if is_read { Outcome::Errors } else { Outcome::Failed }));
    }
    reporter.add(found);
    Ok(settings)
}
