//! Arguments that name a bank or the Lipz files that one is made of.

use crate::Abort;
use crate::reporter::Reporter;
use crate::shared::bank_file::BankFile;
use crate::shared::inputs::with_inputs;
use crate::shared::sources::ProjectArguments;
use crate::{Outcome, console};
use lipz_compiler::is_pattern;
use lipz_compiler::key::EXTENSION;
use lipz_compiler::settings::Settings;
use std::ffi::OsStr;
use std::path::Path;

/// The bank at `path`, or the Lipz files there, packed in memory; without a path, those of `lipz.toml`.
/// Reports what is wrong with them.
pub(crate) fn bank_or_sources(
    path: Option<&Path>,
    arguments: &ProjectArguments,
    reporter: &mut Reporter,
) -> Result<BankFile, Abort> {
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
pub(crate) fn packed(settings: &Settings, quiet: bool, reporter: &mut Reporter) -> Result<BankFile, Abort> {
    let sources: Vec<_> = settings.sources.iter().map(|path| console::path(path)).collect();
    #[allow(clippy::redundant_closure_for_method_calls, reason = "the method is of one lifetime only")]
    let mut run = with_inputs(settings, quiet, |compiler, inputs| compiler.compile(inputs));
    let outcome = run.outcome();
    match run.compiled.bank.take() {
        Some(bank) if outcome == Outcome::Clean => {
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
