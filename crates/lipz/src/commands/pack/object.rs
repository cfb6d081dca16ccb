//! `lipz pack --shard`: the object of one shard of a plan.

use super::Pack;
use crate::reporter::{Abort, Ended, Reporter};
use crate::shared::shard_step;
use crate::{Outcome, console};
use lipz_bank::Bank;
use lipz_compiler::shard::{OBJECT_EXTENSION, Shard, ShardPlan, Step};
use lipz_compiler::{Compiler, Replace};
use lipz_sync::shard::record_hash;
use lipz_sync::{KnownRecordings, SyncRecord, word_times_of};
use std::fs;
use std::path::Path;

/// Makes the object, or takes it from the store.
pub(super) fn run(arguments: &Pack, number: u16, plan: &Path, reporter: &mut Reporter) -> Ended {
    let output = shard_step::output(arguments.output.as_deref(), "3-of-64.lipzobj", reporter)?;
    let shard = shard_step::open(plan, number, Step::Pack, output, reporter)?;
    // A build engine restarts what it cannot prove: an object that was made already is not made again.
    let stored = arguments.store.as_ref().map(|store| store.join(format!("{}.{OBJECT_EXTENSION}", shard.id)));
    let (object, is_stored) = match stored.as_ref().and_then(|stored| of_store(stored)) {
        Some(object) => (object, true),
        None => (make(arguments, &shard, reporter)?, false),
    };
    if let Some(stored) = stored.as_ref().filter(|_| !is_stored) {
        shard_step::write(stored, &object, Replace::Always, reporter)?;
    }
    let is_new = shard_step::write(output, &object, Replace::IfDifferent, reporter)?;
    shard_step::depfile(arguments.depfile.as_deref(), &shard, output, reporter)?;
    if !arguments.sources.is_quiet() {
        let clips = console::counted(shard.inputs().len(), "clip");
        let done = shard_step::done(is_stored, is_new, "packed into");
        let (path, bytes) = (console::path(output), console::grouped(object.len()));
        reporter.summary(&format!("shard {number}: {clips} {done} {path} ({bytes} bytes)\n"))?;
    }
    Ok(Outcome::Clean)
}

/// An object of a store, if it is whole: a machine may have stopped while another program copied it there.
fn of_store(path: &Path) -> Option<Vec<u8>> {
    let object = fs::read(path).ok()?;
    Bank::open(&object).ok()?.verify().ok()?;
    Some(object)
}

fn make(arguments: &Pack, plan: &ShardPlan, reporter: &mut Reporter) -> Result<Vec<u8>, Abort> {
    let (settings, shown) = shard_step::settings(plan, reporter)?;
    let record = SyncRecord::read(Path::new(&plan.record)).map_err(|report| reporter.fail(report))?;
    let changed = plan.changed(|input| record_hash(&record, input));
    if !changed.is_empty() {
        return Err(reporter.refuse(changed));
    }
    let inputs = plan.inputs();
    let (recordings, reports) = KnownRecordings::default().in_bank_with_reports(&settings, &inputs);
    let word_times = word_times_of(&record, &inputs);
    let options = settings.options.clone().recordings(recordings).word_times(word_times).voices(settings.voices());
    let options = options.threads(arguments.sources.threads());
    let mut shard = Shard::new(plan.shard, plan.shards);
    (shard.settings, shard.reports) = (shown, reports);
    let bar = console::progress_bar(inputs.len(), arguments.sources.is_quiet());
    let compiler = Compiler::new(options).progress(|files| bar.inc(files));
    let made = compiler.object(&inputs, &shard);
    bar.finish_and_clear();
    let outcome = Outcome::from_reports(&made.reports);
    match made.bank {
        Some(object) if outcome == Outcome::Clean => {
            // Warnings are shown when the objects are linked, too: all of them, in the order of `lipz pack`.
            reporter.add(made.reports);
            Ok(object)
        }
        _ => Err(reporter.abort(made.reports, outcome)),
    }
}
