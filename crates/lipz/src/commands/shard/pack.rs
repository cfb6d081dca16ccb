//! `lipz shard pack`: makes the object of one shard of a plan.

use super::step::{self, StepArguments};
use crate::commands::Run;
use crate::reporter::{Abort, CommandResult, Reporter};
use crate::{Outcome, console};
use clap::Args;
use lipz_bank::Bank;
use lipz_compiler::shard::{OBJECT_EXTENSION, Shard, ShardPlan, Step};
use lipz_compiler::{Compiler, Replace};
use lipz_sync::shard::record_hash;
use lipz_sync::{FactsCache, SyncRecord, word_times_of};
use std::fs;
use std::path::Path;

/// Pack the clips of one shard into an object, for `lipz shard link`.
#[derive(Args, Debug)]
#[command(after_help = "Example:
  lipz shard pack plan.json 3 -o 3-of-64.lipzobj --store store")]
pub(super) struct PackShard {
    #[command(flatten)]
    step: StepArguments,
}

impl Run for PackShard {
    fn prints_result(&self) -> bool {
        false
    }

    fn run(&self, reporter: &mut Reporter) -> CommandResult {
        run(&self.step, reporter)
    }
}

/// Makes the object, or takes it from the store.
fn run(arguments: &StepArguments, reporter: &mut Reporter) -> CommandResult {
    let number = arguments.shard;
    let output = step::output(&arguments.output, "3-of-64.lipzobj", reporter)?;
    let shard = step::open(&arguments.plan, number, Step::Pack, output, reporter)?;
    // Build engines rerun steps when in doubt. An existing object is not made again.
    let stored = arguments.store.as_ref().map(|store| store.join(format!("{}.{OBJECT_EXTENSION}", shard.id)));
    let (object, is_stored) = match stored.as_ref().and_then(|stored| of_store(stored)) {
        Some(object) => (object, true),
        None => (make(arguments, &shard, reporter)?, false),
    };
    if let Some(stored) = stored.as_ref().filter(|_| !is_stored) {
        step::write(stored, &object, Replace::Always, reporter)?;
    }
    let is_new = step::write(output, &object, Replace::IfDifferent, reporter)?;
    step::depfile(arguments.depfile.as_deref(), &shard, output, reporter)?;
    if !arguments.quiet.is_set() {
        let clips = console::counted(shard.inputs().len(), "clip");
        let done = step::done(is_stored, is_new, "packed into");
        let (path, bytes) = (console::path(output), console::grouped(object.len()));
        reporter.summary(&format!("shard {number}: {clips} {done} {path} ({bytes} bytes)\n"))?;
    }
    Ok(Outcome::Clean)
}

/// Returns a complete object from the store. A machine may have stopped while an object was copied there.
fn of_store(path: &Path) -> Option<Vec<u8>> {
    let object = fs::read(path).ok()?;
    Bank::open(&object).ok()?.verify().ok()?;
    Some(object)
}

fn make(arguments: &StepArguments, plan: &ShardPlan, reporter: &mut Reporter) -> Result<Vec<u8>, Abort> {
    let (settings, shown) = step::settings(plan, reporter)?;
    let record = SyncRecord::read(Path::new(&plan.record)).map_err(|report| reporter.fail(report))?;
    let changed = plan.changed(|input| record_hash(&record, input));
    if !changed.is_empty() {
        return Err(reporter.refuse(changed));
    }
    let inputs = plan.inputs();
    let (recordings, reports) = FactsCache::default().in_bank_with_reports(&settings, &inputs);
    let word_times = word_times_of(&record, &inputs);
    let options = settings.options.clone().recordings(recordings).word_times(word_times).voices(settings.voices());
    let options = options.threads(arguments.jobs.threads());
    let mut shard = Shard::new(plan.shard, plan.shards);
    (shard.settings, shard.reports) = (shown, reports);
    let bar = console::progress_bar(inputs.len(), arguments.quiet.is_set());
    let compiler = Compiler::new(options).progress(|files| bar.inc(files));
    let made = compiler.object(&inputs, &shard);
    bar.finish_and_clear();
    let outcome = Outcome::from_reports(&made.reports);
    match made.bank {
        Some(object) if outcome == Outcome::Clean => {
            // Linking shows these warnings again, all of them in the order of `lipz pack`.
            reporter.add(made.reports);
            Ok(object)
        }
        _ => Err(reporter.abort(made.reports, outcome)),
    }
}
