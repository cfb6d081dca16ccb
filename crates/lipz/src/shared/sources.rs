//! The arguments of commands that read Lipz files: where they are, and which settings hold for them.

use crate::Abort;
use crate::reporter::Reporter;
use crate::shared::lint_flags::LintFlags;
use crate::shared::project_flags::{ProjectFlags, refuse_locales_of};
use crate::shared::settings_file::{Project, SettingsFile};
use crate::shared::stdio;
use clap::Args;
use lipz_diagnostics::{Code, Report};
use std::path::PathBuf;

pub(crate) const PROJECT: &str = "Project";

/// Where Lipz files come from, and what the project decides about them.
#[derive(Args, Debug)]
pub(crate) struct Sources {
    /// Folders, files or glob patterns; `-` reads one Lipz file from standard input [default: those of
    /// lipz.toml]
    #[arg(value_name = "SOURCES")]
    sources: Vec<PathBuf>,

    /// Keys are paths below this folder [default: each source folder]
    #[arg(long, value_name = "FOLDER", help_heading = PROJECT)]
    root: Option<PathBuf>,

    /// Read hidden files and folders, too: those whose names start with a dot
    #[arg(long, value_name = "BOOL", num_args = 0..=1, require_equals = true, default_missing_value = "true",
          help_heading = PROJECT)]
    hidden: Option<bool>,

    #[command(flatten)]
    arguments: ProjectArguments,
}

/// What the project decides about its Lipz files, and how the run goes: also for commands that name
/// their files in other ways.
#[derive(Args, Debug)]
pub(crate) struct ProjectArguments {
    #[command(flatten)]
    file: SettingsFile,

    #[command(flatten)]
    flags: ProjectFlags,

    #[command(flatten)]
    lints: LintFlags,

    /// Threads to use [default: one per core]
    #[arg(long, visible_alias = "jobs", value_name = "COUNT", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,

    /// Show no progress and no summary, only diagnostics
    #[arg(short, long)]
    pub(crate) quiet: bool,
}

impl Sources {
    /// The project that the arguments name. What is wrong with it is printed, and how the run ends is
    /// returned.
    pub(crate) fn project(&self, reporter: &mut Reporter) -> Result<Project, Abort> {
        let mut project = self.arguments.project(&self.sources, reporter)?;
        if self.root.is_some() {
            project.settings.root.clone_from(&self.root);
        }
        project.settings.hidden = self.hidden.unwrap_or(project.settings.hidden);
        Ok(project)
    }

    /// Where the settings file is, or would be.
    pub(crate) fn settings_file(&self) -> Option<PathBuf> {
        self.arguments.file.place(&self.sources)
    }

    /// The paths that the command line names.
    pub(crate) fn paths(&self) -> &[PathBuf] {
        &self.sources
    }

    /// Whether the command line names single files: then nothing is known of the rest of the project.
    pub(crate) fn names_single_files(&self) -> bool {
        let is_file = |path: &PathBuf| stdio::is_meant(path) || path.is_file();
        !self.sources.is_empty() && self.sources.iter().all(is_file)
    }

    /// Threads to use, if that is said.
    pub(crate) fn threads(&self) -> Option<usize> {
        self.arguments.threads.map(usize::from)
    }

    /// Whether to show diagnostics only.
    pub(crate) fn is_quiet(&self) -> bool {
        self.arguments.quiet
    }
}

impl ProjectArguments {
    /// The project to which these sources belong; those of its settings file if there are none.
    pub(crate) fn project(&self, sources: &[PathBuf], reporter: &mut Reporter) -> Result<Project, Abort> {
        let mut project = self.file.project(sources, reporter)?;
        let options = self.flags.apply(std::mem::take(&mut project.settings.options));
        let mut options = options.map_err(|error| reporter.fail(error.to_report()))?;
        self.lints.apply(&mut options);
        project.settings.options = options.threads(self.threads.map(usize::from));
        refuse_locales_of(&project.settings.options, reporter)?;
        Ok(project)
    }
}

/// Drops what is told about recordings of other clips than those of single files.
pub(crate) fn retain_own(reports: &mut Vec<Report>) {
    reports.iter_mut().for_each(|report| report.diagnostics.retain(|found| found.code != Code::RecordingWithoutClip));
    reports.retain(|report| !report.diagnostics.is_empty());
}
