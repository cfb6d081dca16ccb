//! `lipz sync --shard`: the mouths of one shard of a plan.

use super::SyncArguments;
use crate::reporter::{Ended, Reporter};
use crate::shared::shard_step;
use crate::{Outcome, console};
use lipz_compiler::Replace;
use lipz_compiler::shard::{MOUTHS_EXTENSION, Step};
use lipz_sync::shard::{Mouths, mouths};
use lipz_sync::{JOB_PARTS, SyncOptions, SyncRecord};
use std::fs;
use std::path::{Path, PathBuf};

/// Makes the mouths, or takes them from the store.
pub(super) fn run(arguments: &SyncArguments, number: u16, plan: &Path, reporter: &mut Reporter) -> Ended {
    let output = shard_step::output(arguments.output.as_deref(), "3-of-64.lipzmouths", reporter)?;
    let shard = shard_step::open(plan, number, Step::Sync, output, reporter)?;
    let stored = arguments.store.as_ref().map(|store| store.join(format!("{}.{MOUTHS_EXTENSION}", shard.id)));
    let of_store = |path: &PathBuf| Mouths::parse(&fs::read(path).ok()?).ok();
    let (made, is_stored) = match stored.as_ref().and_then(of_store) {
        Some(made) => (made, true),
        None => {
            let (settings, _) = shard_step::settings(&shard, reporter)?;
            // What is wrong with the lexicon is told when all is merged.
            let (mut options, _) = SyncOptions::new_with_report(&settings).map_err(|report| reporter.fail(report))?;
            options.options = std::mem::take(&mut options.options).threads(arguments.sources.threads());
            let record = SyncRecord::read(Path::new(&shard.record)).map_err(|report| reporter.fail(report))?;
            let quiet = arguments.sources.is_quiet();
            let bar = console::progress_bar_of_parts(shard.inputs().len(), JOB_PARTS.into(), quiet);
            let progress = |parts: u32| bar.inc(parts.into());
            let made = mouths(&shard, &settings, &options, &record, &progress);
            bar.finish_and_clear();
            (made.map_err(|reports| reporter.refuse(reports))?, false)
        }
    };
    let json = made.to_json();
    if let Some(stored) = stored.as_ref().filter(|_| !is_stored) {
        shard_step::write(stored, json.as_bytes(), Replace::Always, reporter)?;
    }
    let is_new = shard_step::write(output, json.as_bytes(), Replace::IfDifferent, reporter)?;
    shard_step::depfile(arguments.depfile.as_deref(), &shard, output, reporter)?;
    if !arguments.sources.is_quiet() {
        let mouths = console::counted(made.made_count(), "mouth");
        let refused = match made.refused {
            0 => String::new(),
            refused => {
                format!(" ({} could not be made: `lipz sync --from` says why)", console::counted(refused, "mouth"))
            }
        };
        let done = shard_step::done(is_stored, is_new, "made in");
        reporter.summary(&format!("shard {number}: {mouths} {done} {}{refused}\n", console::path(output)))?;
    }
    Ok(Outcome::Clean)
}
