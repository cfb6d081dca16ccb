//! The arguments of commands that read Lipz files: where they are, and which settings hold for them.

use crate::Outcome;
use crate::args::Arguments;
use crate::lint_flags::LintFlags;
use crate::project::{ProjectFlags, refused_locale};
use crate::render::Findings;
use clap::error::ErrorKind;
use clap::{Args, CommandFactory};
use lipz::Code;
use lipz_compiler::settings::{FILE_NAME, Settings};
use std::path::{Path, PathBuf};

const PROJECT: &str = "Project";

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

    #[command(flatten)]
    arguments: ProjectArguments,
}

/// What the project decides about its Lipz files, and how the run goes: also for commands that name
/// their files in other ways.
#[derive(Args, Debug)]
pub(crate) struct ProjectArguments {
    /// Settings file [default: lipz.toml beside or above the first source, else the current folder]
    #[arg(long, value_name = "FILE", help_heading = PROJECT)]
    config: Option<PathBuf>,

    /// Use no settings file
    #[arg(long, conflicts_with = "config", help_heading = PROJECT)]
    no_config: bool,

    #[command(flatten)]
    flags: ProjectFlags,

    #[command(flatten)]
    lints: LintFlags,

    /// Threads to use [default: one per core]
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,

    /// Show no progress and no summary, only findings
    #[arg(short, long)]
    pub(crate) quiet: bool,
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
    /// The settings file, if it was found in another folder than the current one.
    pub(crate) fn found(&self) -> Option<&Path> {
        self.file.as_deref().filter(|file| !self.is_named && *file != Path::new(FILE_NAME))
    }
}

impl Sources {
    /// The project that the arguments name. What is wrong with it is printed, and how the run ends is
    /// returned.
    pub(crate) fn project(&self, findings: &mut Findings) -> Result<Project, Outcome> {
        let mut project = self.arguments.project(&self.sources, findings)?;
        if self.root.is_some() {
            project.settings.root.clone_from(&self.root);
        }
        Ok(project)
    }

    /// The paths that the command line names.
    pub(crate) fn paths(&self) -> &[PathBuf] {
        &self.sources
    }

    /// Whether to show findings only.
    pub(crate) fn is_quiet(&self) -> bool {
        self.arguments.quiet
    }
}

impl ProjectArguments {
    /// The project to which these sources belong; those of its settings file if there are none.
    pub(crate) fn project(&self, sources: &[PathBuf], findings: &mut Findings) -> Result<Project, Outcome> {
        let file = self.settings_file(sources);
        let mut settings = match &file {
            Some(file) => read(file, findings)?,
            None => Settings::default(),
        };
        if !sources.is_empty() {
            settings.sources = sources.to_vec();
        }
        if settings.sources.is_empty() {
            let tip = format!("name a folder of Lipz files, or make a {FILE_NAME} that does: lipz init");
            return Err(usage_error(
                ErrorKind::MissingRequiredArgument,
                &format!("no sources are named, and there is no {FILE_NAME} in this folder or above it"),
                &tip,
            ));
        }
        let options = &mut settings.options;
        self.flags.apply(options);
        self.lints.apply(&mut options.levels);
        options.threads = self.threads.map(usize::from);
        if let Some(tag) = refused_locale(options) {
            let tip = "name a country, as in en-us, or accept any BCP 47 tag with '--extended-locales'";
            let message = format!("the locale '{tag}' does not have the form ll-cc");
            return Err(usage_error(ErrorKind::ArgumentConflict, &message, tip));
        }
        Ok(Project { settings, file, is_named: self.config.is_some() })
    }

    /// The settings file: the one that is named; otherwise that of the first source, wherever the
    /// command is run; otherwise that of the current folder.
    fn settings_file(&self, sources: &[PathBuf]) -> Option<PathBuf> {
        if self.no_config {
            return None;
        }
        let of_first = || {
            // A pattern or a file lies in the first folder above it.
            let folder = sources.first()?.ancestors().find(|path| path.is_dir())?;
            Settings::find(folder)
        };
        self.config.clone().or_else(of_first).or_else(|| Settings::find(Path::new(".")))
    }
}

/// The settings in `file`; its findings are printed.
fn read(file: &Path, findings: &mut Findings) -> Result<Settings, Outcome> {
    let (settings, report) = Settings::read(file);
    let has_errors = report.has_errors();
    let is_read = report.diagnostics.iter().all(|finding| finding.code != Code::SettingsUnreadable);
    if !report.diagnostics.is_empty() {
        findings.add(vec![report]);
    }
    match (has_errors, is_read) {
        (false, _) => Ok(settings),
        (true, true) => Err(Outcome::Findings),
        (true, false) => Err(Outcome::Failed),
    }
}

/// Prints that the command line is not enough or contradicts itself.
pub(crate) fn usage_error(kind: ErrorKind, message: &str, tip: &str) -> Outcome {
    let _ = Arguments::command().error(kind, format!("{message}\n\n  tip: {tip}")).print();
    Outcome::Failed
}
