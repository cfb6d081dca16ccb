//! The Lipz files of a project, found and worked on.

use crate::reporter::{Abort, Reporter};
use crate::shared::stdio;
use crate::{Outcome, console, interrupt};
use lipz_compiler::settings::Settings;
use lipz_compiler::{Compiled, Compiler, Input, key};
use lipz_diagnostics::reports::{count, have_errors};
use lipz_diagnostics::{Code, Report, Severity};
use lipz_sync::KnownRecordings;
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::time::{Duration, Instant};

/// Finds the inputs of a project and hands them to `work`, with a progress bar; if some cannot be found,
/// they are only checked. Recordings that are `known` are not read again. What discovery found is added to the reports; a run without inputs has none of
/// its own.
pub(crate) fn with_inputs<B>(
    settings: &Settings,
    known: Option<&mut KnownRecordings>,
    quiet: bool,
    work: impl FnOnce(&Compiler<'_>, &[Input]) -> Compiled<B>,
) -> Worked<'static, B> {
    let start = Instant::now();
    let (inputs, reports) = find(settings);
    with_found(settings, Found { inputs: inputs.into(), reports, took: start.elapsed() }, known, quiet, work)
}

/// The inputs of a project that were found before.
pub(crate) struct Found<'i> {
    pub(crate) inputs: Cow<'i, [Input]>,
    pub(crate) reports: Vec<Report>,
    pub(crate) took: Duration,
}

/// The same with inputs that were found before.
pub(crate) fn with_found<'i, B>(
    settings: &Settings,
    found: Found<'i>,
    known: Option<&mut KnownRecordings>,
    quiet: bool,
    work: impl FnOnce(&Compiler<'_>, &[Input]) -> Compiled<B>,
) -> Worked<'i, B> {
    let start = Instant::now();
    let Found { inputs, mut reports, took } = found;
    let (recordings, unread) = known.unwrap_or(&mut KnownRecordings::default()).in_bank_with_reports(settings, &inputs);
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
    Worked { inputs, reports, compiled, discover }
}

/// The inputs of a project, one of which may be standard input, and what is wrong with the others.
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

/// The inputs of a project for a command that cannot do with some of them. Of what was found on the way, warnings are
/// left.
pub(crate) fn find_all(settings: &Settings, reporter: &mut Reporter) -> Result<(Vec<Input>, Vec<Report>), Abort> {
    let (inputs, mut reports) = find(settings);
    key::check(&inputs, &mut reports);
    if have_errors(&reports) {
        let outcome = Outcome::from_reports(&reports);
        return Err(reporter.abort(reports, outcome));
    }
    Ok((inputs, reports))
}

/// The result of a run over source files.
pub(crate) struct Worked<'i, B = Vec<u8>> {
    pub(crate) inputs: Cow<'i, [Input]>,
    pub(crate) reports: Vec<Report>,
    pub(crate) compiled: Compiled<B>,
    pub(crate) discover: Duration,
}

impl<B> Worked<'_, B> {
    /// How the run ends, by its diagnostics: with errors and without a single input, or a way to write the
    /// bank, the tool could not run.
    pub(crate) fn outcome(&self) -> Outcome {
        let mut found = self.reports.iter().flat_map(|report| &report.diagnostics);
        match count(&self.reports, Severity::Error) {
            0 => Outcome::Clean,
            _ if self.inputs.is_empty() || found.any(|found| found.code == Code::OutputFailed) => Outcome::Failed,
            _ => Outcome::Errors,
        }
    }
}
