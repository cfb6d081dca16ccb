//! The settings file of a project: found, read, and named by messages.

use crate::Abort;
use crate::Outcome;
use crate::reporter::Reporter;
use crate::shared::sources::PROJECT;
use crate::shared::stdio;
use clap::Args;
use lipz_compiler::settings::{FILE_NAME, Settings};
use lipz_diagnostics::Code;
use std::path::{Path, PathBuf};

/// Which settings file applies.
#[derive(Args, Debug)]
pub(crate) struct SettingsFile {
    /// Settings file [default: lipz.toml beside or above the first source, else the current folder]
    #[arg(long, value_name = "FILE", help_heading = PROJECT)]
    config: Option<PathBuf>,

    /// Use no settings file
    #[arg(long, conflicts_with = "config", help_heading = PROJECT)]
    no_config: bool,

    /// What `-` reads is the text of this file: diagnostics name it, its lipz.toml holds
    #[arg(long, value_name = "FILE", help_heading = PROJECT)]
    stdin_filename: Option<PathBuf>,
}

/// What a run works with: the settings file, with the command line's arguments over it.
pub(crate) struct Project {
    /// The settings.
    pub(crate) settings: Settings,
    /// The file that they come from.
    pub(crate) file: Option<PathBuf>,
    /// Whether the command line names the file.
    is_named: bool,
}

impl Project {
    /// A project that an editor has found.
    pub(crate) fn found_by_editor(settings: Settings, file: Option<PathBuf>) -> Project {
        Project { settings, file, is_named: false }
    }

    /// The settings file, if it was found in another folder than the current one.
    pub(crate) fn found(&self) -> Option<&Path> {
        self.file.as_deref().filter(|file| !self.is_named && *file != Path::new(FILE_NAME))
    }
}

impl SettingsFile {
    /// The project to which these sources belong; those of its settings file if there are none. What is
    /// wrong with it is printed, and how the run ends is returned.
    pub(crate) fn project(&self, sources: &[PathBuf], reporter: &mut Reporter) -> Result<Project, Abort> {
        if let Some(file) = &self.stdin_filename {
            if !sources.iter().any(|source| stdio::is_meant(source)) {
                let tip = "name `-` among the sources, or leave out `--stdin-filename`";
                return Err(reporter.usage("standard input is not read, so it is no text of a file".to_owned(), tip));
            }
            stdio::is_text_of(file.clone());
        }
        let file = self.find(sources);
        let mut settings = match &file {
            Some(file) => read(file, reporter)?,
            None => Settings::default(),
        };
        if let Some(file) = &self.stdin_filename {
            // Its key is that which the file has in the project.
            let source = settings.sources.iter().find(|source| file.starts_with(source));
            settings.root = settings.root.take().or_else(|| source.cloned());
        }
        if !sources.is_empty() {
            settings.sources = sources.to_vec();
        }
        if settings.sources.is_empty() {
            let tip = format!("name a folder of Lipz files, or create a {FILE_NAME} that does: lipz init");
            return Err(reporter
                .usage(format!("no sources are named, and there is no {FILE_NAME} in this folder or above it"), &tip));
        }
        Ok(Project { settings, file, is_named: self.config.is_some() })
    }

    /// The settings file that applies, or would apply if it were created in the current folder; `None` if
    /// none is wanted.
    pub(crate) fn place(&self, sources: &[PathBuf]) -> Option<PathBuf> {
        let file = || self.find(sources).unwrap_or_else(|| FILE_NAME.into());
        (!self.no_config).then(file)
    }

    /// The settings file: the one that is named, otherwise that of the sources.
    fn find(&self, sources: &[PathBuf]) -> Option<PathBuf> {
        if self.no_config {
            return None;
        }
        // Standard input is where its file is.
        let place = |source: &PathBuf| match &self.stdin_filename {
            Some(file) if stdio::is_meant(source) => file.clone(),
            _ => source.clone(),
        };
        let places: Vec<PathBuf> = sources.iter().map(place).collect();
        self.config.clone().or_else(|| Settings::find_of(&places))
    }
}

/// The settings in `file`; its diagnostics are printed.
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
