//! `lipz check`: the diagnostics of source files, and their certain fixes.

mod baseline;
mod fixing;
mod statistics;
pub(crate) mod translations;

use crate::Ended;
use crate::Outcome;
use crate::commands::Run;
use crate::console;
use crate::reporter::Reporter;
use crate::shared::audio_flags::AudioFlags;
use crate::shared::inputs::{Worked, with_inputs};
use crate::shared::output_file;
use crate::shared::project_flags::hide_of_banks;
use crate::shared::rewriting::{Rewriting, files};
use crate::shared::settings_file::Project;
use crate::shared::sources::{Sources, retain_own};
use crate::shared::stdio;
use baseline::BaselineFlags;
use clap::Args;
use fixing::{Fixing, fix_all};
use lipz_compiler::settings::Settings;
use lipz_compiler::{Content, Input};
use lipz_diagnostics::Report;
use std::borrow::Cow;
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use translations::Translations;

/// Check Lipz files without packing them.
///
/// With a folder of recordings, clips and recordings are compared, too: missing ones, and other lengths.
/// Translations are compared with the default locale, and with what lipz-texts.txt says they were made from.
///
/// --fix applies the fixes that are certain: those that do not change the bank, and those of errors whose
/// intent is beyond doubt. The remaining diagnostics are reported and decide the exit code.
#[derive(Args, Debug)]
#[command(mut_args(hide_of_banks))]
#[command(after_help = "Examples:
  lipz check
  lipz check voices
  lipz check voices/act1/mara-hello.lipz
  lipz check - < draft.lipz
  lipz check voices --audio recordings
  lipz check --diff voices
  lipz check --statistics voices
  lipz check voices --cache check.cache
  lipz check voices --baseline baseline.txt --write-baseline
  lipz check --format junit voices > lipz.xml")]
pub(crate) struct Check {
    #[command(flatten)]
    sources: Sources,

    #[command(flatten)]
    audio: AudioFlags,

    #[command(flatten)]
    baseline: BaselineFlags,

    /// Apply the fixes that are certain
    #[arg(long)]
    fix: bool,

    /// Show the fixes as a unified diff, and write nothing
    #[arg(long, visible_alias = "dry-run")]
    diff: bool,

    /// Remember in FILE the Lipz files in which nothing was found, so that the next check reads only those that
    /// changed. It finds the same, and is safe to delete. Not the cache of `lipz pack`
    #[arg(long, value_name = "FILE")]
    cache: Option<PathBuf>,

    /// Show how often each rule has reported, instead of the diagnostics
    #[arg(long, conflicts_with = "diff")]
    statistics: bool,

    /// Print these counts as JSON
    #[arg(long, requires = "statistics")]
    json: bool,
}

/// What to say of a project whose translations may all be out of date, and how to be told no more.
const UNRECORDED: &str = "hint: nobody knows what the translations were made from, so none can be out of date. `lipz accept --all` \
                          records them as they are today; with `stale-translation = \"allow\"` under [lints] in lipz.toml this \
                          hint ends\n";

impl Run for Check {
    fn prints_result(&self) -> bool {
        self.diff || self.statistics
    }

    fn run(&self, reporter: &mut Reporter) -> Ended {
        let mut project = self.sources.project(reporter)?;
        self.audio.apply(&mut project.settings.audio);
        // Only a bank has what is read of recordings for it.
        project.settings.audio.in_bank = false;
        self.cache.iter().try_for_each(|cache| output_file::refuse_source(cache, reporter))?;
        let (settings, quiet) = (&project.settings, self.sources.is_quiet());
        if (self.fix || self.diff) && settings.sources.iter().any(|source| stdio::is_meant(source)) {
            let tip = "save it in a file, or leave out `--fix` and `--diff`";
            return Err(reporter.usage("standard input cannot be fixed in place", tip));
        }
        let fixing = match (self.fix, self.diff) {
            (_, true) => fix_all(settings, quiet, Rewriting::Diff),
            (true, false) => fix_all(settings, quiet, Rewriting::InPlace),
            (false, false) => Fixing::default(),
        };
        let (mut run, is_unrecorded) = checked(&project, &fixing.in_memory, self.cache.as_deref(), quiet);
        if self.sources.names_single_files() {
            retain_own(&mut run.reports);
        }
        let unwritten = !fixing.unwritten.is_empty();
        run.reports.extend(fixing.unwritten);
        let passed_over = self.baseline.apply(&mut run, reporter)?;
        let outcome = run.outcome();
        if self.statistics {
            statistics::print(&run.reports, reporter.wants_json(self.json), reporter)?;
        }
        if !self.statistics || !reporter.is_for_people() {
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
            // While there are errors, there is other work to do; warnings do not keep it away.
            if is_unrecorded && project.file.is_some() {
                reporter.summary(UNRECORDED)?;
            }
        }
        Ok(if unwritten { Outcome::Failed } else { outcome })
    }
}

/// All that is wrong with a project: its Lipz files, some of which have other texts than on disk, by name; their
/// recordings; and their translations. Also whether nothing is known of these. With a cache, only files that changed are read.
pub(crate) fn checked(
    project: &Project,
    in_memory: &HashMap<String, String>,
    cache: Option<&Path>,
    quiet: bool,
) -> (Worked<'static>, bool) {
    let settings = &project.settings;
    let mut translations = None;
    let mut run = with_inputs(settings, None, quiet, |compiler, inputs| {
        let inputs = instead(inputs, in_memory);
        // Each file is read once, for both.
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
    run.reports.dedup(); // both read the record of mouths
    (run, translations.is_unrecorded)
}

/// The inputs, those with other texts than on disk with these.
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

/// What does not belong together: clips and recordings, if the project has a folder of them.
fn with_recordings(settings: &Settings, inputs: &[Input], quiet: bool) -> Vec<Report> {
    if settings.audio.folder.is_none() {
        return Vec::new();
    }
    let bar = console::progress_bar(inputs.len(), quiet);
    let reports = lipz_sync::check(settings, inputs, &|| bar.inc(1));
    bar.finish_and_clear();
    reports
}
