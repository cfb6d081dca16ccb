//! The arguments of commands that read Lipz files: their paths and settings.

use crate::Abort;
use crate::console;
use crate::reporter::Reporter;
use crate::shared::lint_flags::LintFlags;
use crate::shared::run_flags::{JobsFlag, QuietFlag};
use crate::shared::settings_file::{Project, SettingsFile};
use crate::shared::stdio;
use clap::Args;
use lipz_diagnostics::{Code, Report};
use std::path::{Path, PathBuf};

pub(crate) const PROJECT: &str = "Project";

/// The sources of Lipz files, and the settings of their project.
#[derive(Args, Debug)]
pub(crate) struct Sources {
    /// Folders, files or patterns; `-` is a Lipz file on standard input [default: those of lipz.toml]
    #[arg(value_name = "SOURCES")]
    sources: Vec<PathBuf>,

    #[command(flatten)]
    arguments: ProjectArguments,
}

/// The settings of a project and of a run. They are separate for commands that name their files differently.
#[derive(Args, Debug)]
pub(crate) struct ProjectArguments {
    #[command(flatten)]
    file: SettingsFile,

    #[command(flatten)]
    lints: LintFlags,

    #[command(flatten)]
    jobs: JobsFlag,

    #[command(flatten)]
    pub(crate) quiet: QuietFlag,
}

impl Sources {
    /// Returns the project that the arguments name. Reports its problems.
    pub(crate) fn project(&self, reporter: &mut Reporter) -> Result<Project, Abort> {
        self.arguments.project(&self.sources, reporter)
    }

    /// Returns the path of the settings file, which may not exist.
    pub(crate) fn settings_file(&self) -> Option<PathBuf> {
        self.arguments.file.place(&self.sources)
    }

    /// Returns the paths that the command line names.
    pub(crate) fn paths(&self) -> &[PathBuf] {
        &self.sources
    }

    /// Whether the command line names single files. Then the rest of the project is not read.
    pub(crate) fn names_single_files(&self) -> bool {
        let is_file = |path: &PathBuf| stdio::is_meant(path) || path.is_file();
        !self.sources.is_empty() && self.sources.iter().all(is_file)
    }

    /// Refuses settings together with a bank.
    pub(crate) fn refuse_with_bank(&self, bank: &Path, reporter: &mut Reporter) -> Result<(), Abort> {
        self.arguments.refuse_with_bank(bank, reporter)
    }

    /// Whether to show only diagnostics.
    pub(crate) fn is_quiet(&self) -> bool {
        self.arguments.quiet.is_set()
    }
}

impl ProjectArguments {
    /// Returns the project of these sources, or of its settings file if there are none.
    pub(crate) fn project(&self, sources: &[PathBuf], reporter: &mut Reporter) -> Result<Project, Abort> {
        let mut project = self.file.project(sources, reporter)?;
        let options = &mut project.settings.options;
        self.lints.apply(options);
        *options = std::mem::take(options).threads(self.jobs.threads());
        Ok(project)
    }

    /// Refuses settings and lint levels together with a bank, because they apply to Lipz files.
    pub(crate) fn refuse_with_bank(&self, bank: &Path, reporter: &mut Reporter) -> Result<(), Abort> {
        let option = match (self.file.is_used(), self.lints.is_used()) {
            (true, _) => "--config",
            (_, true) => "--allow, --warn and --deny",
            (false, false) => return Ok(()),
        };
        let message = format!("`{}` is a bank, which {option} cannot change", console::path(bank));
        Err(reporter.usage(message, "leave out the option, or name the Lipz files"))
    }
}

/// Removes the reports about recordings and lines without a clip, because single files are not the whole project.
pub(crate) fn retain_own(reports: &mut Vec<Report>) {
    let is_own = |code: Code| !matches!(code, Code::RecordingWithoutClip | Code::LineWithoutClip);
    reports.iter_mut().for_each(|report| report.diagnostics.retain(|found| is_own(found.code)));
    reports.retain(|report| !report.diagnostics.is_empty());
}
