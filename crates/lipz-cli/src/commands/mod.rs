//! The commands, one file each.

pub(crate) mod check;
pub(crate) mod convert;
mod fixing;
pub(crate) mod fmt;
pub(crate) mod inspect;
pub(crate) mod pack;
pub(crate) mod unpack;
pub(crate) mod verify;

use crate::sources::Sources;
use crate::{Outcome, console};
use lipz_compiler::{Compiled, Input, Options, Progress, Report, discover};
use std::time::{Duration, Instant};

/// Finds the inputs and hands them to `work`, with a progress bar. What discovery found is added to
/// the reports; a run without inputs has none of its own.
fn with_inputs(
    sources: &Sources,
    options: &Options,
    work: impl FnOnce(&[Input], &Options, &Progress<'_>) -> Compiled,
) -> Run {
    let start = Instant::now();
    let (inputs, mut reports) = discover(&sources.sources, sources.root.as_deref());
    let discover = start.elapsed();
    let bar = console::progress_bar(inputs.len(), sources.quiet);
    let mut compiled = work(&inputs, options, &|count| bar.inc(count));
    bar.finish_and_clear();
    reports.append(&mut compiled.reports);
    reports.sort_by(|a, b| a.source.path.cmp(&b.source.path));
    Run { file_count: inputs.len(), reports, compiled, discover }
}

/// What a run over source files gave.
struct Run {
    file_count: usize,
    reports: Vec<Report>,
    compiled: Compiled,
    discover: Duration,
}

impl Run {
    /// How a run with findings at error level ends: without a single input, the tool could not run.
    fn failure(&self) -> Outcome {
        if self.file_count == 0 { Outcome::Failed } else { Outcome::Findings }
    }
}
