//! Arguments that name a bank or the Lipz files that one is made of.

use super::with_inputs;
use crate::bank_file::BankFile;
use crate::render::Findings;
use crate::sources::ProjectArguments;
use crate::{Outcome, console};
use lipz_compiler::compile;
use lipz_compiler::settings::Settings;
use std::path::Path;

/// The bank at `path`, or the Lipz files there, packed in memory. Reports what is wrong with them.
pub(super) fn bank_or_files(
    path: &Path,
    arguments: &ProjectArguments,
    findings: &mut Findings,
) -> Result<BankFile, Outcome> {
    if !names_lipz_files(path) {
        return BankFile::open(path, findings);
    }
    let project = arguments.project(&[path.to_owned()], findings)?;
    packed(path, &project.settings, arguments.quiet, findings)
}

/// The bank of the Lipz files at `path`, packed in memory. Reports what is wrong with them.
pub(super) fn packed(
    path: &Path,
    settings: &Settings,
    quiet: bool,
    findings: &mut Findings,
) -> Result<BankFile, Outcome> {
    let mut run = with_inputs(settings, quiet, compile);
    let outcome = run.outcome();
    findings.add(run.reports);
    match run.compiled.bank.take() {
        Some(bank) if outcome == Outcome::Clean => Ok(BankFile::made(console::path(path), bank)),
        _ => Err(outcome),
    }
}

/// Whether a path is that of Lipz files: a folder, a pattern, a file `.lipz`.
pub(super) fn names_lipz_files(path: &Path) -> bool {
    let is_pattern = || !path.exists() && path.to_string_lossy().contains(['*', '?', '[']);
    path.is_dir() || path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("lipz")) || is_pattern()
}
