//! Arguments that name a bank, or the Lipz files of one.

use crate::Abort;
use crate::reporter::Reporter;
use crate::shared::bank_file::BankFile;
use crate::shared::dialogue_files::DialogueFiles;
use crate::shared::inputs::with_inputs;
use crate::shared::settings_file::Project;
use crate::shared::sources::ProjectArguments;
use crate::shared::stack;
use crate::{Outcome, console};
use clap::Args;
use lipz_compiler::key::EXTENSION;
use lipz_compiler::settings::Settings;
use lipz_compiler::{Input, is_pattern};
use std::ffi::OsStr;
use std::path::{Path, PathBuf};

/// The dialogue that a command looks at as a whole.
#[derive(Args, Debug)]
pub(crate) struct DialogueArguments {
    /// Bank or set, also with patches and text banks (BANK+PATCH+TEXTS), or Lipz files [default: those of lipz.toml]
    ///
    /// `-` is a bank on standard input.
    #[arg(value_name = "BANK")]
    bank: Option<PathBuf>,

    #[command(flatten)]
    arguments: ProjectArguments,
}

impl DialogueArguments {
    /// Returns the project of the bank or the Lipz files.
    pub(crate) fn project(&self, reporter: &mut Reporter) -> Result<Project, Abort> {
        self.arguments.project(self.bank.as_slice(), reporter)
    }

    /// Returns the files of the bank or set with its text banks, or the Lipz files of the project packed in memory. Reports
    /// their problems.
    pub(crate) fn files_of(&self, project: &Project, reporter: &mut Reporter) -> Result<DialogueFiles, Abort> {
        self.files_with_clip(project, None, reporter)
    }

    /// Returns the files for a command about one clip, without warnings about the other files.
    pub(crate) fn files_with_clip(
        &self,
        project: &Project,
        key: Option<&str>,
        reporter: &mut Reporter,
    ) -> Result<DialogueFiles, Abort> {
        match &self.bank {
            Some(bank) if self.is_bank() => {
                self.arguments.refuse_with_bank(bank, reporter)?;
                DialogueFiles::open(bank, reporter)
            }
            _ => packed_for(&project.settings, self.arguments.quiet.is_set(), key, reporter).map(DialogueFiles::one),
        }
    }

    /// Returns the path of the bank, if it is one.
    pub(crate) fn bank_path(&self) -> Option<&Path> {
        self.bank.as_deref().filter(|_| self.is_bank())
    }

    /// Returns the path of the bank, if it is one. Refuses options that do not apply to banks.
    pub(crate) fn bank_without_options(&self, reporter: &mut Reporter) -> Result<Option<&Path>, Abort> {
        let bank = self.bank_path();
        bank.map_or(Ok(()), |bank| self.arguments.refuse_with_bank(bank, reporter))?;
        Ok(bank)
    }

    /// Whether it is a bank instead of Lipz files.
    pub(crate) fn is_bank(&self) -> bool {
        self.bank.as_ref().is_some_and(|bank| !names_lipz_files(bank))
    }

    /// Whether the arguments name a file or a pattern of Lipz files, and not a folder.
    pub(crate) fn names_file(&self) -> bool {
        self.bank.as_ref().is_some_and(|path| names_lipz_files(path) && !path.is_dir())
    }

    /// Whether to hide the progress.
    pub(crate) fn is_quiet(&self) -> bool {
        self.arguments.quiet.is_set()
    }
}

/// Returns the bank or set at `path`, or its Lipz files packed in memory. Reports their problems.
pub(crate) fn bank_or_sources(
    path: &Path,
    arguments: &ProjectArguments,
    reporter: &mut Reporter,
) -> Result<DialogueFiles, Abort> {
    if !names_lipz_files(path) {
        return DialogueFiles::open(path, reporter);
    }
    let project = arguments.project(&[path.to_owned()], reporter)?;
    packed(&project.settings, arguments.quiet.is_set(), reporter).map(DialogueFiles::one)
}

/// Returns the bank of a project's Lipz files, packed in memory. Reports their problems.
pub(crate) fn packed(settings: &Settings, quiet: bool, reporter: &mut Reporter) -> Result<BankFile, Abort> {
    packed_for(settings, quiet, None, reporter)
}

/// Like `packed`. With a key, reports only the warnings about that clip.
fn packed_for(settings: &Settings, quiet: bool, key: Option<&str>, reporter: &mut Reporter) -> Result<BankFile, Abort> {
    let sources: Vec<_> = settings.sources.iter().map(|path| console::path(path)).collect();
    #[allow(clippy::redundant_closure_for_method_calls, reason = "the method has only one lifetime")]
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

/// Whether a path names Lipz files: a folder, a pattern, or a file `.lipz`. In a stack, a pattern can name text banks.
pub(crate) fn names_lipz_files(path: &Path) -> bool {
    let is_lipz = |extension: &OsStr| extension.eq_ignore_ascii_case(EXTENSION);
    let is_stack = || matches!(stack::paths(path).as_slice(), [bank, _, ..] if !is_pattern(bank));
    path.is_dir() || path.extension().is_some_and(is_lipz) || is_pattern(path) && !is_stack()
}
