//! Arguments that name a bank or the Lipz files that one is made of.

use crate::Abort;
use crate::reporter::Reporter;
use crate::shared::bank_file::BankFile;
use crate::shared::dialogue_files::DialogueFiles;
use crate::shared::inputs::{find, with_inputs};
use crate::shared::settings_file::Project;
use crate::shared::sources::ProjectArguments;
use crate::shared::text_banks::TextBanks;
use crate::{Outcome, console};
use clap::Args;
use lipz_compiler::key::EXTENSION;
use lipz_compiler::settings::Settings;
use lipz_compiler::{Input, is_pattern};
use lipz_diagnostics::reports::have_errors;
use lipz_sync::Recorded;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};

/// The dialogue that a command looks at as a whole.
#[derive(Args, Debug)]
pub(crate) struct DialogueArguments {
    /// A bank or a set, or a folder, file or pattern of Lipz files; `-` is a bank on standard input [default: the
    /// Lipz files of lipz.toml]
    #[arg(value_name = "BANK")]
    bank: Option<PathBuf>,

    #[command(flatten)]
    texts: TextBanks,

    #[command(flatten)]
    arguments: ProjectArguments,
}

impl DialogueArguments {
    /// The files of the bank or set with its text banks, or the Lipz files packed in memory. Reports what is wrong with them.
    pub(crate) fn files(&self, reporter: &mut Reporter) -> Result<DialogueFiles, Abort> {
        let files = bank_or_sources(self.bank.as_deref(), &self.arguments, reporter)?;
        files.with_texts(&self.texts.texts, reporter)
    }

    /// Whether text banks are named.
    pub(crate) fn has_texts(&self) -> bool {
        !self.texts.texts.is_empty()
    }

    /// The same, and of Lipz files, how much of them is recorded, if their project has recordings.
    pub(crate) fn files_and_recorded(
        &self,
        reporter: &mut Reporter,
    ) -> Result<(DialogueFiles, Option<Recorded>), Abort> {
        if self.is_bank() {
            return Ok((self.files(reporter)?, None));
        }
        let project = self.project(reporter)?;
        let files = self.files_of(&project, reporter)?;
        let (inputs, _) = find(&project.settings);
        let (recorded, reports) = Recorded::count_with_reports(&project.settings, &inputs);
        if have_errors(&reports) {
            let outcome = Outcome::from_reports(&reports);
            return Err(reporter.abort(reports, outcome));
        }
        reporter.add(reports);
        Ok((files, recorded))
    }

    /// The project to which the bank or the Lipz files belong.
    pub(crate) fn project(&self, reporter: &mut Reporter) -> Result<Project, Abort> {
        self.arguments.project(self.bank.as_slice(), reporter)
    }

    /// [`files`](Self::files), with settings that are read already.
    pub(crate) fn files_of(&self, project: &Project, reporter: &mut Reporter) -> Result<DialogueFiles, Abort> {
        self.files_with_clip(project, None, reporter)
    }

    /// The same for somebody who looks at one clip: warnings about other files are none of theirs.
    pub(crate) fn files_with_clip(
        &self,
        project: &Project,
        key: Option<&str>,
        reporter: &mut Reporter,
    ) -> Result<DialogueFiles, Abort> {
        let files = match &self.bank {
            Some(bank) if self.is_bank() => DialogueFiles::open(bank, reporter)?,
            _ => DialogueFiles::one(packed_for(&project.settings, self.arguments.quiet, key, reporter)?),
        };
        files.with_texts(&self.texts.texts, reporter)
    }

    /// The path of the bank, if it is one.
    pub(crate) fn bank_path(&self) -> Option<&Path> {
        self.bank.as_deref().filter(|_| self.is_bank())
    }

    /// Whether it is a bank, and not Lipz files.
    pub(crate) fn is_bank(&self) -> bool {
        self.bank.as_ref().is_some_and(|bank| !names_lipz_files(bank))
    }

    /// Whether a file or a pattern of Lipz files is named, and no folder.
    pub(crate) fn names_file(&self) -> bool {
        self.bank.as_ref().is_some_and(|path| names_lipz_files(path) && !path.is_dir())
    }

    /// Whether to show no progress.
    pub(crate) fn is_quiet(&self) -> bool {
        self.arguments.quiet
    }
}

/// The bank or set at `path`, or the Lipz files there, packed in memory; without a path, those of `lipz.toml`.
/// Reports what is wrong with them.
pub(crate) fn bank_or_sources(
    path: Option<&Path>,
    arguments: &ProjectArguments,
    reporter: &mut Reporter,
) -> Result<DialogueFiles, Abort> {
    match path {
        Some(path) if !names_lipz_files(path) => DialogueFiles::open(path, reporter),
        path => {
            let sources: Vec<_> = path.into_iter().map(Path::to_owned).collect();
            let project = arguments.project(&sources, reporter)?;
            packed(&project.settings, arguments.quiet, reporter).map(DialogueFiles::one)
        }
    }
}

/// The bank of a project's Lipz files, packed in memory. Reports what is wrong with them.
pub(crate) fn packed(settings: &Settings, quiet: bool, reporter: &mut Reporter) -> Result<BankFile, Abort> {
    packed_for(settings, quiet, None, reporter)
}

/// The same; of warnings, only those about the clip with this key, if it is one clip that somebody looks at.
fn packed_for(settings: &Settings, quiet: bool, key: Option<&str>, reporter: &mut Reporter) -> Result<BankFile, Abort> {
    let sources: Vec<_> = settings.sources.iter().map(|path| console::path(path)).collect();
    #[allow(clippy::redundant_closure_for_method_calls, reason = "the method is of one lifetime only")]
    let mut run = with_inputs(settings, None, quiet, |compiler, inputs| compiler.compile(inputs));
    let outcome = run.outcome();
    match run.compiled.bank.take() {
        Some(bank) if outcome == Outcome::Clean => {
            if let Some(key) = key {
                let file = run.inputs.iter().find(|input| input.key == key).map(Input::name);
                run.reports.retain(|report| Some(&report.source.path) == file.as_ref());
            }
            reporter.add(run.reports);
            Ok(BankFile::made(sources.join(", "), bank))
        }
        _ => Err(reporter.abort(run.reports, outcome)),
    }
}

/// Whether a path is that of Lipz files: a folder, a pattern, a file `.lipz`.
pub(crate) fn names_lipz_files(path: &Path) -> bool {
    let is_lipz = |extension: &OsStr| extension.eq_ignore_ascii_case(EXTENSION);
    path.is_dir() || path.extension().is_some_and(is_lipz) || is_pattern(path)
}
