//! The commands, one file each.

pub(crate) mod check;
pub(crate) mod inspect;
pub(crate) mod pack;
pub(crate) mod unpack;
pub(crate) mod verify;

use crate::sources::Sources;
use crate::{Outcome, console};
use lipz::{Code, Level};
use lipz_compiler::{Compiled, Input, Options, Progress, Report, check_all, count, discover};
use std::time::{Duration, Instant};

/// Finds the inputs and hands them to `work`, with a progress bar; if some cannot be found, they are only
/// checked. What discovery found is added to the reports; a run without inputs has none of its own.
fn with_inputs(
    sources: &Sources,
    options: &Options,
    work: impl Fn(&[Input], &Options, &Progress<'_>) -> Compiled,
) -> Run {
    let start = Instant::now();
    let (inputs, mut reports) = discover(&sources.sources, sources.root.as_deref());
    let discover = start.elapsed();
    let bar = console::progress_bar(inputs.len(), sources.quiet);
    let progress = |files| bar.inc(files);
    let mut compiled = match count(&reports, Level::Error) {
        0 => work(&inputs, options, &progress),
        _ => check_all(&inputs, options, &progress),
    };
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
    /// How a run with findings at error level ends: without a single input, or a way to write the bank,
    /// the tool could not run.
    fn failure(&self) -> Outcome {
        let mut findings = self.reports.iter().flat_map(|report| &report.diagnostics);
        let could_not_run = self.file_count == 0 || findings.any(|found| found.code == Code::OutputFailed);
        if could_not_run { Outcome::Failed } else { Outcome::Findings }
    }
}
