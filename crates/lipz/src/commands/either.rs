//! Arguments that name a bank or the Lipz files that one is made of.

use super::with_inputs;
use crate::bank_file::BankFile;
use crate::reporter::Reporter;
use crate::sources::ProjectArguments;
use crate::{Outcome, console};
use lipz_compiler::is_pattern;
use lipz_compiler::key::EXTENSION;
use lipz_compiler::settings::Settings;
use std::ffi::OsStr;
use std::path::Path;

/// The bank at `path`, or the Lipz files there, packed in memory; without a path, those of `lipz.toml`.
/// Reports what is wrong with them.
pub(super) fn bank_or_files(
    path: Option<&Path>,
    arguments: &ProjectArguments,
    reporter: &mut Reporter,
) -> Result<BankFile, Outcome> {
    match path {
        Some(path) if !names_lipz_files(path) => BankFile::open(path, reporter),
        path => {
            let sources: Vec<_> = path.into_iter().map(Path::to_owned).collect();
            let project = arguments.project(&sources, reporter)?;
            packed(&project.settings, arguments.quiet, reporter)
        }
    }
}

/// The bank of a project's Lipz files, packed in memory. Reports what is wrong with them.
pub(super) fn packed(settings: &Settings, quiet: bool, reporter: &mut Reporter) -> Result<BankFile, Outcome> {
    let sources: Vec<_> = settings.sources.iter().map(|path| console::path(path)).collect();
    let mut run = with_inputs(settings, quiet, |compiler, inputs| compiler.compile(inputs));
    let outcome = run.outcome();
    reporter.add(run.reports);
    match run.compiled.bank.take() {
        Some(bank) if outcome == Outcome::Clean => Ok(BankFile::made(sources.join(", "), bank)),
        _ => Err(outcome),
    }
}

/// Whether a path is that of Lipz files: a folder, a pattern, a file `.lipz`.
pub(super) fn names_lipz_files(path: &Path) -> bool {
    let is_lipz = |extension: &OsStr| extension.eq_ignore_ascii_case(EXTENSION);
    path.is_dir() || path.extension().is_some_and(is_lipz) || is_pattern(path)
}
