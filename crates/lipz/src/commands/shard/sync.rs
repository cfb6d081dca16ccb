//! `lipz shard sync`: makes the visemes of one shard of a plan.

use super::step::{self, StepArguments};
use crate::commands::Run;
use crate::reporter::{CommandResult, Reporter};
use crate::{Outcome, console};
use clap::Args;
use lipz_compiler::Replace;
use lipz_compiler::shard::{MOUTHS_EXTENSION, Step};
use lipz_sync::shard::{Mouths, mouths};
use lipz_sync::{JOB_PARTS, SyncOptions, SyncRecord};
use std::fs;
use std::path::{Path, PathBuf};

/// Make the visemes of one shard from recordings, for `lipz shard merge`.
#[derive(Args, Debug)]
#[command(after_help = "Example:
  lipz shard sync sync.json 3 -o 3-of-64.lipzmouths --store store")]
pub(super) struct SyncShard {
    #[command(flatten)]
    step: StepArguments,
}

impl Run for SyncShard {
    fn prints_result(&self) -> bool {
        false
    }

    fn run(&self, reporter: &mut Reporter) -> CommandResult {
        run(&self.step, reporter)
    }
}

/// Makes the visemes, or takes them from the store.
fn run(arguments: &StepArguments, reporter: &mut Reporter) -> CommandResult {
    let number = arguments.shard;
    let output = step::output(&arguments.output, "3-of-64.lipzmouths", reporter)?;
    let shard = step::open(&arguments.plan, number, Step::Sync, output, reporter)?;
    let stored = arguments.store.as_ref().map(|store| store.join(format!("{}.{MOUTHS_EXTENSION}", shard.id)));
    let of_store = |path: &PathBuf| Mouths::parse(&fs::read(path).ok()?).ok();
    let (made, is_stored) = match stored.as_ref().and_then(of_store) {
        Some(made) => (made, true),
        None => {
            let (settings, _) = step::settings(&shard, reporter)?;
            // The merge reports the problems of the lexicon.
            let (mut options, _) = SyncOptions::new_with_report(&settings).map_err(|report| reporter.fail(report))?;
            options.options = std::mem::take(&mut options.options).threads(arguments.jobs.threads());
            let record = SyncRecord::read(Path::new(&shard.record)).map_err(|report| reporter.fail(report))?;
            let quiet = arguments.quiet.is_set();
            let bar = console::progress_bar_of_parts(shard.inputs().len(), JOB_PARTS.into(), quiet);
            let progress = |parts: u32| bar.inc(parts.into());
            let made = mouths(&shard, &settings, &options, &record, &progress);
            bar.finish_and_clear();
            (made.map_err(|reports| reporter.refuse(reports))?, false)
        }
    };
    let json = made.to_json();
    if let Some(stored) = stored.as_ref().filter(|_| !is_stored) {
        step::write(stored, json.as_bytes(), Replace::Always, reporter)?;
    }
    let is_new = step::write(output, json.as_bytes(), Replace::IfDifferent, reporter)?;
    step::depfile(arguments.depfile.as_deref(), &shard, output, reporter)?;
    if !arguments.quiet.is_set() {
        let clips = console::counted(made.made_count(), "clip");
        let refused = match made.refused {
            0 => String::new(),
            refused => {
                format!("; {} failed, and `lipz shard merge` reports the reasons", console::counted(refused, "clip"))
            }
        };
        let done = step::done(is_stored, is_new, "written to");
        reporter.summary(&format!("shard {number}: visemes of {clips} {done} {}{refused}\n", console::path(output)))?;
    }
    Ok(Outcome::Clean)
}
