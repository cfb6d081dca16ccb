//! `lipz check`: the findings of source files.

use super::with_inputs;
use crate::sources::Sources;
use crate::{Outcome, console, render};
use clap::Args;
use lipz_compiler::check_all;

/// Check Lipz files without packing them.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz check voices
  lipz check voices/act1/mara-hello.lipz
  lipz check - < draft.lipz")]
pub(crate) struct Check {
    #[command(flatten)]
    pub(crate) sources: Sources,
}

pub(crate) fn run(arguments: &Check) -> Outcome {
    let Sources { places, project } = &arguments.sources;
    let run = with_inputs(places, project.quiet, &project.options(), check_all);
    render::findings(&run.reports);
    if run.has_errors() {
        return run.failure();
    }
    if project.quiet {
        return Outcome::Clean;
    }
    console::print(&format!("{} checked\n", console::counted(run.file_count, "file")))
}
