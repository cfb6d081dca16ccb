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
  lipz check voices
  lipz check voices/act1/mara-hello.lipz")]
pub(crate) struct Check {
    #[command(flatten)]
    pub(crate) sources: Sources,
}

pub(crate) fn run(arguments: &Check, findings: &mut Findings) -> Outcome {
    let sources = &arguments.sources;
    let run = with_inputs(sources, &sources.options(), check_all);
    let outcome = run.outcome();
    findings.add(run.reports);
    if outcome != Outcome::Clean || sources.quiet {
        return outcome;
    }
    findings.summary(&format!("{} checked\n", console::counted(run.file_count, "file")))
}
