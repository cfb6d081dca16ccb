//! `lipz check`: the findings of source files, and their certain fixes.

use super::fixing::{Fixing, fix_all};
use super::with_inputs;
use crate::project::hide_of_banks;
use crate::reporter::Reporter;
use crate::rewriting::{Rewriting, files};
use crate::sources::{Sources, usage_error};
use crate::{Ended, Outcome, console, standard};
use clap::Args;
use clap::error::ErrorKind;

/// Check Lipz files without packing them.
///
/// With --fix, certain fixes are made in the files: those that leave the bank as it is, and those of
/// errors where what was meant is beyond doubt. What remains is reported, and decides the exit code.
#[derive(Args, Debug)]
#[command(mut_args(hide_of_banks))]
#[command(after_help = "Examples:
  lipz check
  lipz check voices
  lipz check voices/act1/mara-hello.lipz
  lipz check - < draft.lipz
  lipz check --fix --diff voices")]
pub(crate) struct Check {
    #[command(flatten)]
    sources: Sources,

    /// Make the fixes that are certain
    #[arg(long)]
    fix: bool,

    /// Show the fixes as a unified diff, and write nothing
    #[arg(long, visible_alias = "dry-run", requires = "fix")]
    diff: bool,
}

pub(crate) fn run(arguments: &Check, reporter: &mut Reporter) -> Ended {
    let project = arguments.sources.project(reporter)?;
    let (settings, quiet) = (&project.settings, arguments.sources.is_quiet());
    if arguments.fix && settings.sources.iter().any(|source| standard::is_meant(source)) {
        let tip = "save it in a file, or leave out '--fix'";
        return Err(usage_error(ErrorKind::ArgumentConflict, "standard input is no file that can be fixed", tip));
    }
    let fixing = match (arguments.fix, arguments.diff) {
        (false, _) => Fixing::default(),
        (true, false) => fix_all(settings, quiet, Rewriting::InPlace),
        (true, true) => fix_all(settings, quiet, Rewriting::Diff),
    };
    let mut run = with_inputs(settings, quiet, |compiler, inputs| compiler.check(&fixing.instead_of(inputs)));
    let unwritten = !fixing.unwritten.is_empty();
    run.reports.extend(fixing.unwritten);
    let outcome = run.outcome();
    reporter.add(run.reports);
    let printed = if arguments.diff { console::print(&fixing.changes) } else { reporter.summary(&fixing.changes) };
    Ok(match outcome {
        _ if unwritten => Outcome::Failed,
        Outcome::Clean if quiet || arguments.diff => printed,
        Outcome::Clean => reporter.summary(&format!("{} checked\n", files(run.inputs.len()))),
        outcome => outcome,
    })
}

impl Check {
    /// Whether standard output is for differences.
    pub(crate) fn prints_diff(&self) -> bool {
        self.diff
    }
}
