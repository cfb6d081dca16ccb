//! `lipz check`: the findings of source files.

use super::with_inputs;
use crate::render::Findings;
use crate::sources::Sources;
use crate::{Outcome, console};
use clap::Args;
use lipz_compiler::check_all;

/// Check Lipz files without packing them.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz check
  lipz check voices
  lipz check voices/act1/mara-hello.lipz
  lipz check - < draft.lipz")]
pub(crate) struct Check {
    #[command(flatten)]
    sources: Sources,
}

pub(crate) fn run(arguments: &Check, findings: &mut Findings) -> Outcome {
    let project = match arguments.sources.project(findings) {
        Ok(project) => project,
        Err(outcome) => return outcome,
    };
    let quiet = arguments.sources.is_quiet();
    let run = with_inputs(&project.settings, quiet, check_all);
    let outcome = run.outcome();
    findings.add(run.reports);
    if outcome != Outcome::Clean || quiet {
        return outcome;
    }
    findings.summary(&format!("{} checked\n", console::counted(run.inputs.len(), "file")))
}
