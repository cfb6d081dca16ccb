//! The commands, one file each.

pub(crate) mod babble;
mod babble_json;
pub(crate) mod check;
pub(crate) mod completions;
pub(crate) mod convert;
pub(crate) mod coverage;
pub(crate) mod diff;
mod either;
pub(crate) mod explain;
pub(crate) mod export;
pub(crate) mod fallout;
mod fixing;
pub(crate) mod fmt;
mod foreign;
pub(crate) mod ids;
pub(crate) mod import;
pub(crate) mod init;
pub(crate) mod inspect;
mod locale_choice;
pub(crate) mod man;
pub(crate) mod maps;
pub(crate) mod pack;
pub(crate) mod schema;
pub(crate) mod stats;
pub(crate) mod subtitles;
pub(crate) mod unpack;
pub(crate) mod verify;
pub(crate) mod watch;

use crate::{Outcome, console, interrupt, standard};
use lipz_compiler::settings::Settings;
use lipz_compiler::{Compiled, Compiler, Input};
use lipz_diagnostics::{Code, Report, Severity, count};
use std::time::{Duration, Instant};

/// Finds the inputs of a project and hands them to `work`, with a progress bar; if some cannot be found,
/// they are only checked. What discovery found is added to the reports; a run without inputs has none of
/// its own.
fn with_inputs(settings: &Settings, quiet: bool, work: impl FnOnce(&Compiler<'_>, &[Input]) -> Compiled) -> Run {
    let start = Instant::now();
    let (inputs, mut reports) = find(settings);
    let discover = start.elapsed();
    let bar = console::progress_bar(inputs.len(), quiet);
    let compiler = Compiler::new(settings.options.clone()).progress(|files| {
        bar.inc(files);
        interrupt::point();
    });
    let mut compiled = match count(&reports, Severity::Error) {
        0 => work(&compiler, &inputs),
        _ => compiler.check(&inputs),
    };
    bar.finish_and_clear();
    reports.append(&mut compiled.reports);
    reports.sort_by(|a, b| a.source.path.cmp(&b.source.path));
    Run { inputs, reports, compiled, discover }
}

/// The inputs of a project, one of which may be standard input, and what is wrong with the others.
fn find(settings: &Settings) -> (Vec<Input>, Vec<Report>) {
    let (standard, paths) = settings.sources.iter().cloned().partition::<Vec<_>, _>(|path| standard::is_meant(path));
    let mut on_disk = settings.clone();
    on_disk.sources = paths;
    let (mut inputs, mut reports) = on_disk.discover();
    if !standard.is_empty() {
        match standard::lipz_file() {
            Ok(input) => inputs.push(input),
            Err(report) => reports.push(report),
        }
    }
    (inputs, reports)
}

/// What a run over source files gave.
struct Run {
    inputs: Vec<Input>,
    reports: Vec<Report>,
    compiled: Compiled,
    discover: Duration,
}

impl Run {
    /// How the run ends, by its findings: with errors and without a single input, or a way to write the
    /// bank, the tool could not run.
    fn outcome(&self) -> Outcome {
        let mut reporter = self.reports.iter().flat_map(|report| &report.diagnostics);
        match count(&self.reports, Severity::Error) {
            0 => Outcome::Clean,
            _ if self.inputs.is_empty() || reporter.any(|found| found.code == Code::OutputFailed) => Outcome::Failed,
            _ => Outcome::Errors,
        }
    }
}
