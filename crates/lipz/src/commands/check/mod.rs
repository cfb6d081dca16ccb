//! `lipz check`: the diagnostics of source files, and their certain fixes.

mod baseline;
mod fallout_heads;
mod fix_result;
mod fonts;
mod lines;
mod statistics;
pub(crate) mod translations;
mod unused_patterns;

use crate::CommandResult;
use crate::Outcome;
use crate::commands::Run;
use crate::console;
use crate::reporter::Reporter;
use crate::shared::audio_flag::AudioFlag;
use crate::shared::inputs::{RunResult, with_inputs};
use crate::shared::output_file;
use crate::shared::rewrite_mode::{RewriteMode, files};
use crate::shared::settings_file::Project;
use crate::shared::sources::{Sources, retain_own};
use crate::shared::stdin_file::StdinFile;
use crate::shared::stdio;
use baseline::BaselineFlags;
use clap::{Args, ValueEnum};
use fix_result::{FixResult, fix_all};
use lipz_compiler::settings::Settings;
use lipz_compiler::{Compiler, Content, Input};
use lipz_diagnostics::Report;
use std::borrow::Cow;
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use translations::Translations;

/// Check Lipz files, recordings and translations.
///
/// With a folder of recordings, lipz also reports clips without a recording, recordings without a clip, and different
/// lengths. Translations are compared with the default locale, and with the source texts recorded in lipz-texts.txt.
///
/// --fix applies only safe fixes: those that do not change the bank, and those of errors with one possible meaning. The
/// remaining diagnostics are reported and decide the exit code.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz check
  lipz check voices
  lipz check voices/act1/mara-hello.lipz
  lipz check - < draft.lipz
  lipz check voices --audio recordings
  lipz check --diff voices
  lipz check voices --lines game/dialogue.tab
  lipz check voices --show stats
  lipz check --fallout-heads data/art/heads
  lipz check voices --cache check.cache
  lipz check voices --baseline baseline.txt --write-baseline
  lipz check --output-format junit voices > lipz.xml")]
pub(crate) struct Check {
    #[command(flatten)]
    sources: Sources,

    #[command(flatten)]
    stdin: StdinFile,

    #[command(flatten)]
    audio: AudioFlag,

    #[command(flatten)]
    baseline: BaselineFlags,

    /// Apply the safe fixes
    #[arg(long)]
    fix: bool,

    /// Show the fixes as a unified diff, and write nothing
    #[arg(long)]
    diff: bool,

    /// Cache in FILE, so that the next check reads only changed files
    ///
    /// The file lists the Lipz files without diagnostics, and is safe to delete. It is not the cache of `lipz pack`.
    #[arg(long, value_name = "FILE")]
    cache: Option<PathBuf>,

    /// Compare the clips with a script: a table (Ren'Py, Yarn Spinner, Unreal, CSV), JSON (Ink, articy) or .msg file
    /// (Fallout)
    #[arg(long, value_name = "FILE", conflicts_with_all = ["fix", "diff"])]
    lines: Option<PathBuf>,

    /// Show the number of diagnostics of each rule instead of the diagnostics
    #[arg(long, value_enum, value_name = "WHAT", conflicts_with = "diff")]
    show: Option<CheckView>,

    /// Check images of Fallout 2's talking heads instead: FRM files, lists and folders
    #[arg(long, value_name = "FILES", num_args = 1.., conflicts_with_all = ABOUT_LIPZ_FILES)]
    fallout_heads: Vec<PathBuf>,
}

/// The arguments that do not apply to images.
const ABOUT_LIPZ_FILES: [&str; 16] = [
    "sources",
    "config",
    "no_config",
    "stdin_filename",
    "allow",
    "warn",
    "deny",
    "jobs",
    "audio",
    "baseline",
    "write_baseline",
    "fix",
    "diff",
    "cache",
    "lines",
    "show",
];

/// The hint for a project that does not record its source texts.
const UNRECORDED: &str = "hint: lipz cannot detect stale translations yet. Run `lipz approve --all` to start recording source \
                          texts, or set `stale-translation = \"allow\"` in [lints] of lipz.toml\n";

#[derive(ValueEnum, Clone, Copy, Debug)]
enum CheckView {
    /// Counts for each rule
    Stats,
}

impl Run for Check {
    fn prints_result(&self) -> bool {
        self.diff || self.show.is_some() || !self.fallout_heads.is_empty()
    }

    fn run(&self, reporter: &mut Reporter) -> CommandResult {
        if !self.fallout_heads.is_empty() {
            return fallout_heads::run(&self.fallout_heads, self.sources.is_quiet(), reporter);
        }
        self.stdin.apply(self.sources.paths(), reporter)?;
        let mut project = self.sources.project(reporter)?;
        self.audio.apply(&mut project.settings.audio, reporter)?;
        // The contents of recordings matter only for a bank.
        project.settings.audio.in_bank = false;
        self.cache.iter().try_for_each(|cache| output_file::refuse_source(cache, reporter))?;
        let (settings, quiet) = (&project.settings, self.sources.is_quiet());
        if (self.fix || self.diff) && settings.sources.iter().any(|source| stdio::is_meant(source)) {
            let tip = "save it in a file, or leave out `--fix` and `--diff`";
            return Err(reporter.usage("standard input cannot be fixed in place", tip));
        }
        let fixing = match (self.fix, self.diff) {
            (_, true) => fix_all(settings, quiet, RewriteMode::Diff),
            (true, false) => fix_all(settings, quiet, RewriteMode::InPlace),
            (false, false) => FixResult::default(),
        };
        let (mut run, is_unrecorded) = checked(&project, &fixing.in_memory, self.cache.as_deref(), quiet);
        let has_ambiguous_texts = match &self.lines {
            Some(lines) => lines::check(lines, &project, &mut run, reporter)?,
            None => false,
        };
        if let (Some(file), []) = (&project.file, self.sources.paths()) {
            run.reports.extend(unused_patterns::check(&project, file, &run.inputs));
        }
        if self.sources.names_single_files() {
            retain_own(&mut run.reports);
        }
        let unwritten = !fixing.unwritten.is_empty();
        run.reports.extend(fixing.unwritten);
        let passed_over = self.baseline.apply(&mut run, reporter)?;
        let outcome = run.outcome();
        if self.show.is_some() {
            statistics::print(&run.reports, reporter.wants_json(), reporter)?;
        }
        if self.show.is_none() || !reporter.is_for_people() {
            reporter.add(run.reports);
        }
        if self.diff {
            reporter.print(&fixing.changes)?;
        } else {
            reporter.summary(&fixing.changes)?;
        }
        if !quiet && !self.prints_result() {
            reporter.summary(&passed_over)?;
        }
        if outcome == Outcome::Clean && !quiet && !self.prints_result() {
            reporter.summary(&format!("{} checked\n", files(run.inputs.len())))?;
            // Errors come first. Warnings do not suppress the hints.
            if has_ambiguous_texts {
                reporter.summary(lines::AMBIGUOUS)?;
            }
            if is_unrecorded && project.file.is_some() {
                reporter.summary(UNRECORDED)?;
            }
        }
        Ok(if unwritten { Outcome::Failed } else { outcome })
    }
}

/// Returns all problems of a project: of its Lipz files, some of which may be replaced in memory, by name; of their
/// recordings; and of their translations. Also returns whether the source texts of these are unrecorded. With a cache,
/// only changed files are read.
pub(crate) fn checked(
    project: &Project,
    in_memory: &HashMap<String, String>,
    cache: Option<&Path>,
    quiet: bool,
) -> (RunResult<'static>, bool) {
    let settings = &project.settings;
    let mut translations = None;
    let mut run = with_inputs(settings, None, quiet, |compiler, inputs| {
        let inputs = instead(inputs, in_memory);
        // Each file is read once, for both checks.
        match Translations::open(project, &inputs) {
            Ok(opened) => {
                let lint = |input: &Input, bytes: &[u8]| opened.lint(input, bytes);
                let checked = match cache {
                    Some(cache) => compiler.check_cached(&inputs, &lint, cache, &opened.beside()),
                    None => compiler.check_with(&inputs, &lint),
                };
                translations = Some(opened.found(checked.linted, checked.marked));
                checked.compiled
            }
            Err(_) => compiler.check(&inputs),
        }
    });
    let inputs = instead(&run.inputs, in_memory);
    run.reports.extend(with_recordings(settings, &inputs, quiet));
    let translations = translations.unwrap_or_else(|| translations::check(project, &inputs, quiet));
    run.reports.extend(translations.reports);
    lipz_diagnostics::reports::sort(&mut run.reports);
    run.reports.dedup(); // both read the sync record
    (run, translations.is_unrecorded)
}

/// Returns the problems of these Lipz files and their translations, in files that are not on disk too. Recordings are not
/// read.
pub(crate) fn check_files(project: &Project, inputs: &[Input]) -> Vec<Report> {
    let compiler = Compiler::new(project.settings.options.clone());
    let mut reports = match Translations::open(project, inputs) {
        Ok(opened) => {
            let checked = compiler.check_with(inputs, &|input, bytes| opened.lint(input, bytes));
            let mut reports = checked.compiled.reports;
            reports.extend(opened.found(checked.linted, checked.marked).reports);
            reports
        }
        Err(report) => {
            let mut reports = compiler.check(inputs).reports;
            reports.push(report);
            reports
        }
    };
    lipz_diagnostics::reports::sort(&mut reports);
    reports
}

/// Returns the inputs, with the texts of `in_memory` in place of those on disk.
fn instead<'i>(inputs: &'i [Input], in_memory: &HashMap<String, String>) -> Cow<'i, [Input]> {
    if in_memory.is_empty() {
        return Cow::Borrowed(inputs);
    }
    let instead = |input: &Input| match in_memory.get(&input.name()) {
        Some(text) => {
            let content = Content::Bytes { name: input.name(), bytes: text.clone().into_bytes() };
            Input { key: input.key.clone(), content }
        }
        None => input.clone(),
    };
    inputs.iter().map(instead).collect()
}

/// Returns mismatches between clips and recordings, if the project has a folder of recordings.
fn with_recordings(settings: &Settings, inputs: &[Input], quiet: bool) -> Vec<Report> {
    if settings.audio.folder.is_none() {
        return Vec::new();
    }
    let bar = console::progress_bar(inputs.len(), quiet);
    let reports = lipz_sync::check(settings, inputs, &|| bar.inc(1));
    bar.finish_and_clear();
    reports
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Command;
    use std::collections::BTreeSet;

    #[test]
    fn images_are_checked_without_arguments_about_lipz_files() {
        let command = Check::augment_args(Command::new("check"));
        let all: BTreeSet<&str> = command.get_arguments().map(|argument| argument.get_id().as_str()).collect();
        assert_eq!(&all - &BTreeSet::from(["fallout_heads", "quiet"]), ABOUT_LIPZ_FILES.into());
    }
}
