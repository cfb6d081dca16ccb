//! `lipz check`: the diagnostics of source files, and their certain fixes.

mod fixing;
mod statistics;
mod translations;

use crate::Ended;
use crate::Outcome;
use crate::commands::Run;
use crate::reporter::Reporter;
use crate::shared::audio_flags::AudioFlags;
use crate::shared::inputs::with_inputs;
use crate::shared::project_flags::hide_of_banks;
use crate::shared::rewriting::{Rewriting, files};
use crate::shared::sources::Sources;
use crate::shared::stdio;
use crate::{console, interrupt};
use clap::Args;
use fixing::{Fixing, fix_all};
use lipz_compiler::Input;
use lipz_compiler::settings::Settings;
use lipz_diagnostics::Report;

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
  lipz check --format junit voices > lipz.xml")]
pub(crate) struct Check {
    #[command(flatten)]
    sources: Sources,

    #[command(flatten)]
    audio: AudioFlags,

    /// Apply the fixes that are certain
    #[arg(long)]
    fix: bool,

    /// Show the fixes as a unified diff, and write nothing
    #[arg(long, visible_alias = "dry-run")]
    diff: bool,

    /// Show how often each rule has reported, instead of the diagnostics
    #[arg(long, conflicts_with = "diff")]
    statistics: bool,

    /// Print these counts as JSON
    #[arg(long, requires = "statistics")]
    json: bool,
}

impl Run for Check {
    fn prints_result(&self) -> bool {
        self.diff || self.statistics
    }

    fn run(&self, reporter: &mut Reporter) -> Ended {
        let mut project = self.sources.project(reporter)?;
        self.audio.apply(&mut project.settings.audio);
        // Only a bank has what is read of recordings for it.
        project.settings.audio.in_bank = false;
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
        let mut run = with_inputs(settings, None, quiet, |compiler, inputs| compiler.check(&fixing.instead_of(inputs)));
        run.reports.extend(with_recordings(settings, &fixing.instead_of(&run.inputs), quiet));
        run.reports.extend(translations::check(&project, &fixing.instead_of(&run.inputs), quiet));
        lipz_diagnostics::reports::sort(&mut run.reports);
        run.reports.dedup(); // both read the record of mouths
        let unwritten = !fixing.unwritten.is_empty();
        run.reports.extend(fixing.unwritten);
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
        if outcome == Outcome::Clean && !quiet && !self.prints_result() {
            reporter.summary(&format!("{} checked\n", files(run.inputs.len())))?;
        }
        Ok(if unwritten { Outcome::Failed } else { outcome })
    }
}

/// What does not belong together: clips and recordings, if the project has a folder of them.
fn with_recordings(settings: &Settings, inputs: &[Input], quiet: bool) -> Vec<Report> {
    if settings.audio.folder.is_none() {
        return Vec::new();
    }
    let bar = console::progress_bar(inputs.len(), quiet);
    let reports = lipz_sync::check(settings, inputs, &|| {
        bar.inc(1);
        interrupt::point();
    });
    bar.finish_and_clear();
    reports
}
