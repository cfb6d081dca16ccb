//! The result of a command as its exit code.

use lipz_diagnostics::{Code, Report, Severity};
use std::process::ExitCode;

/// The result of a command. Of two, the greater is the worse.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(crate) enum Outcome {
    /// 0: no diagnostics at error level.
    Clean,
    /// 1: diagnostics at error level.
    Errors,
    /// 2: the tool could not run.
    Failed,
}

impl Outcome {
    /// Returns the outcome of a run with these diagnostics: failed if a file was not found, read or written.
    pub(crate) fn from_reports(reports: &[Report]) -> Outcome {
        let diagnostics = reports.iter().flat_map(|report| &report.diagnostics);
        let errors = diagnostics.filter(|diagnostic| diagnostic.severity == Severity::Error);
        let of_code = |code| match code {
            Code::OutputFailed | Code::UnreadableFile | Code::NoSources => Outcome::Failed,
            _ => Outcome::Errors,
        };
        errors.map(|diagnostic| of_code(diagnostic.code)).max().unwrap_or(Outcome::Clean)
    }
}

impl From<Outcome> for ExitCode {
    fn from(outcome: Outcome) -> ExitCode {
        ExitCode::from(match outcome {
            Outcome::Clean => 0,
            Outcome::Errors => 1,
            Outcome::Failed => 2,
        })
    }
}
