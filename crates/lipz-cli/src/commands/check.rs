//! `lipz check`: the findings of source files.

use super::with_inputs;
use crate::sources::Sources;
use crate::{Outcome, console, render};
use clap::Args;
use lipz::Level;
use lipz_compiler::{check_all, count};

/// Check Lipz files without packing them.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz check voices
  lipz check voices/act1/mara-hello.lipz")]
pub(crate) struct Check {
    #[command(flatten)]
    pub(crate) sources: Sources,
}

pub(crate) fn run(arguments: &Check) -> Outcome {
    let sources = &arguments.sources;
    let run = with_inputs(sources, &sources.options(), check_all);
    render::findings(&run.reports);
    if count(&run.reports, Level::Error) > 0 {
        return run.failure();
    }
    if sources.quiet {
        return Outcome::Clean;
    }
    console::print(&format!("{} checked\n", console::counted(run.inputs.len(), "file")))
}
