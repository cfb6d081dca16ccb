//! `lipz check`: the findings of source files, and their certain fixes.

use super::fixing::{Fixing, fix_all};
use super::with_inputs;
use crate::rewriting::{Rewriting, files};
use crate::sources::Sources;
use crate::{Outcome, console, render};
use clap::Args;
use lipz::Level;
use lipz_compiler::{check_all, count};

/// Check Lipz files without packing them.
///
/// With --fix, certain fixes are made in the files: those that leave the bank as it is, and those of
/// errors where what was meant is beyond doubt. What remains is reported, and decides the exit code.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz check voices
  lipz check voices/act1/mara-hello.lipz
  lipz check --fix --diff voices")]
pub(crate) struct Check {
    #[command(flatten)]
    pub(crate) sources: Sources,

    /// Make the fixes that are certain
    #[arg(long)]
    fix: bool,

    /// Show the fixes as a unified diff, and write nothing
    #[arg(long, visible_alias = "dry-run", requires = "fix")]
    diff: bool,
}

pub(crate) fn run(arguments: &Check) -> Outcome {
    let sources = &arguments.sources;
    let options = sources.options();
    let fixing = match (arguments.fix, arguments.diff) {
        (false, _) => Fixing::default(),
        (true, false) => fix_all(sources, &options, Rewriting::InPlace),
        (true, true) => fix_all(sources, &options, Rewriting::Diff),
    };
    let mut run = with_inputs(sources, &options, |inputs, options, progress| {
        check_all(&fixing.instead_of(inputs), options, progress)
    });
    let unwritten = !fixing.unwritten.is_empty();
    run.reports.extend(fixing.unwritten);
    render::findings(&run.reports);
    let printed = console::print(&fixing.changes);
    if unwritten {
        return Outcome::Failed;
    }
    if count(&run.reports, Level::Error) > 0 {
        return run.failure();
    }
    if sources.quiet || arguments.diff {
        return printed;
    }
    console::print(&format!("{} checked\n", files(run.file_count)))
}
