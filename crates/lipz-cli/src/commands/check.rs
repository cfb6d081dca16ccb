//! `lipz check`: the findings of source files, and their certain fixes.

use super::with_inputs;
use crate::rewriting::{Rewriting, files};
use crate::sources::Sources;
use crate::{Outcome, console, render};
use clap::Args;
use lipz::Level;
use lipz::diagnostic::show;
use lipz_compiler::{Content, Fixed, Input, Options, Report, check_all, count, discover, each_file, fix};
use std::collections::HashMap;

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
    let fixing = if arguments.fix { fix_all(arguments, &options) } else { Fixing::default() };
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
    if sources.quiet {
        return printed;
    }
    console::print(&format!("{} checked\n", files(run.file_count)))
}

/// What fixing gave.
#[derive(Default)]
struct Fixing {
    /// What was fixed in each file, or the differences.
    changes: String,
    /// Files that are to be checked as if they were fixed.
    in_memory: HashMap<String, String>,
    /// Files that could not be written.
    unwritten: Vec<Report>,
}

impl Fixing {
    /// The inputs, those that are only fixed in memory with their new texts.
    fn instead_of(&self, inputs: &[Input]) -> Vec<Input> {
        let fixed = |input: &Input| match self.in_memory.get(&input.name) {
            Some(text) => Input { content: Content::Bytes(text.clone().into_bytes()), ..input.clone() },
            None => input.clone(),
        };
        inputs.iter().map(fixed).collect()
    }
}

/// Fixes all files, or shows what would be fixed.
fn fix_all(arguments: &Check, options: &Options) -> Fixing {
    let rewriting = if arguments.diff { Rewriting::Diff } else { Rewriting::InPlace };
    // What cannot be found or read is reported by the check that follows.
    let (inputs, _) = discover(&arguments.sources.sources, arguments.sources.root.as_deref());
    let bar = console::progress_bar(inputs.len(), arguments.sources.quiet);
    let results = each_file(&inputs, options, &|count| bar.inc(count), |input, bytes| {
        let fixed = fix(bytes, options)?;
        Some(rewriting.rewrite(input, bytes, &fixed.text).map(|difference| (fixed, difference)))
    });
    bar.finish_and_clear();
    let mut fixing = Fixing::default();
    for (input, result) in std::iter::zip(inputs, results) {
        match result {
            Ok(Some(Ok((fixed, difference)))) => {
                if arguments.diff {
                    fixing.changes.push_str(&difference);
                    fixing.in_memory.insert(input.name, fixed.text);
                } else if !arguments.sources.quiet {
                    fixing.changes.push_str(&format!("{}: {} fixed\n", show::text(&input.name), mended(&fixed)));
                }
            }
            Ok(Some(Err(report))) => fixing.unwritten.push(report),
            Ok(None) | Err(_) => {}
        }
    }
    fixing
}

/// `3 findings (LZ0402, LZ0501)`.
fn mended(fixed: &Fixed) -> String {
    let codes: Vec<&str> = fixed.mended.keys().map(|code| code.number()).collect();
    format!("{} ({})", console::counted(fixed.mended.values().sum(), "finding"), codes.join(", "))
}
