//! Finding and processing the Lipz files of a project.

use crate::reporter::{Abort, Reporter};
use crate::shared::stdio;
use crate::{Outcome, console, interrupt};
use lipz_compiler::settings::Settings;
use lipz_compiler::{Compiled, Compiler, Input, key};
use lipz_diagnostics::reports::{count, have_errors};
use lipz_diagnostics::{Code, Report, Severity};
use lipz_sync::FactsCache;
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::time::{Duration, Instant};

/// Finds the inputs of a project and passes them to `work`, with a progress bar. If some cannot be found, they are only
/// checked. Recordings that are `known` are not read again. The reports include those of the discovery; a run without
/// inputs has no others.
pub(crate) fn with_inputs<B>(
    settings: &Settings,
    known: Option<&mut FactsCache>,
    quiet: bool,
    work: impl FnOnce(&Compiler<'_>, &[Input]) -> Compiled<B>,
) -> RunResult<'static, B> {
    let start = Instant::now();
    let (inputs, reports) = find(settings);
    with_found(settings, FoundInputs { inputs: inputs.into(), reports, took: start.elapsed() }, known, quiet, work)
}

/// Inputs of a project, found earlier.
pub(crate) struct FoundInputs<'i> {
    pub(crate) inputs: Cow<'i, [Input]>,
    pub(crate) reports: Vec<Report>,
    pub(crate) took: Duration,
}

/// Like `with_inputs`, with inputs that were found earlier.
pub(crate) fn with_found<'i, B>(
    settings: &Settings,
    found: FoundInputs<'i>,
    known: Option<&mut FactsCache>,
    quiet: bool,
    work: impl FnOnce(&Compiler<'_>, &[Input]) -> Compiled<B>,
) -> RunResult<'i, B> {
    let start = Instant::now();
    let FoundInputs { inputs, mut reports, took } = found;
    let (recordings, unread) = known.unwrap_or(&mut FactsCache::default()).in_bank_with_reports(settings, &inputs);
    reports.extend(unread);
    let word_times = lipz_sync::word_times(settings, &inputs).unwrap_or_else(|report| {
        reports.push(report);
        BTreeMap::new()
    });
    let options = settings.options.clone().recordings(recordings).word_times(word_times).voices(settings.voices());
    let discover = took + start.elapsed();
    let bar = console::progress_bar(inputs.len(), quiet);
    let compiler = Compiler::new(options).progress(|files| bar.inc(files));
    let compiler = compiler.around_writes(|write| interrupt::whole(write));
    let mut compiled = match count(&reports, Severity::Error) {
        0 => work(&compiler, &inputs),
        _ => compiler.check(&inputs).without_bank(),
    };
    bar.finish_and_clear();
    reports.append(&mut compiled.reports);
    reports.sort_by(|a, b| a.source.path.cmp(&b.source.path));
    RunResult { inputs, reports, compiled, discover }
}

/// Returns the inputs of a project, which may include standard input, and reports about the unusable ones.
pub(crate) fn find(settings: &Settings) -> (Vec<Input>, Vec<Report>) {
    let (standard, paths) = settings.sources.iter().cloned().partition::<Vec<_>, _>(|path| stdio::is_meant(path));
    let mut on_disk = settings.clone();
    on_disk.sources = paths;
    let (mut inputs, mut reports) = on_disk.discover_with_reports();
    if !standard.is_empty() {
        match stdio::lipz_file(settings.root.as_deref()) {
            Ok(input) => inputs.push(input),
            Err(report) => reports.push(report),
        }
    }
    (inputs, reports)
}

/// Returns the inputs of a project for a command that needs all of them, with the warnings of the discovery.
pub(crate) fn find_all(settings: &Settings, reporter: &mut Reporter) -> Result<(Vec<Input>, Vec<Report>), Abort> {
    let (inputs, mut reports) = find(settings);
    key::check(&inputs, &mut reports);
    if have_errors(&reports) {
        let outcome = Outcome::from_reports(&reports);
        return Err(reporter.abort(reports, outcome));
    }
    Ok((inputs, reports))
}

/// The result of a run on source files.
pub(crate) struct RunResult<'i, B = Vec<u8>> {
    pub(crate) inputs: Cow<'i, [Input]>,
    pub(crate) reports: Vec<Report>,
    pub(crate) compiled: Compiled<B>,
    pub(crate) discover: Duration,
}

impl<B> RunResult<'_, B> {
    /// Returns the outcome of the run from its diagnostics: failed, if there are errors and either no inputs or no way
    /// to write the bank.
    pub(crate) fn outcome(&self) -> Outcome {
        let mut found = self.reports.iter().flat_map(|report| &report.diagnostics);
        match count(&self.reports, Severity::Error) {
            0 => Outcome::Clean,
            _ if self.inputs.is_empty() || found.any(|found| found.code == Code::OutputFailed) => Outcome::Failed,
            _ => Outcome::Errors,
        }
    }
}
