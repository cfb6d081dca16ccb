//! `lipz pack --shard`: the object of one shard of a plan.

use super::Pack;
use crate::reporter::{Abort, Ended, Reporter};
use crate::shared::{output_file, stdio};
use crate::{Outcome, console, interrupt};
use lipz_bank::Bank;
use lipz_compiler::settings::Settings;
use lipz_compiler::shard::{OBJECT_EXTENSION, Plan, Shard, ShardPlan};
use lipz_compiler::{Compiler, OutputFile, Replace};
use lipz_diagnostics::{Code, Report};
use std::fs;
use std::path::{Path, PathBuf};

/// Makes the object, or takes it from the store.
pub(super) fn run(arguments: &Pack, number: u16, plan: &Path, reporter: &mut Reporter) -> Ended {
    let output = output(arguments, reporter)?;
    let plan_file = plan;
    output_file::refuse_same(&[("the plan", plan_file), ("the object", output)], reporter)?;
    let plan = Plan::read(plan_file).map_err(|report| reporter.refuse(vec![report]))?;
    let Some(shard) = plan.shards.get(usize::from(number)) else {
        let shards = console::counted(plan.shards.len(), "shard");
        return Err(reporter.usage(format!("there is no shard {number}: the plan has {shards}"), "they count from 0"));
    };
    // A build engine restarts what it cannot prove: an object that was made already is not made again.
    let shard = plan.read_shard(shard, plan_file).map_err(|report| reporter.refuse(vec![report]))?;
    let stored = arguments.store.as_ref().map(|store| store.join(format!("{}.{OBJECT_EXTENSION}", shard.id)));
    let (object, is_stored) = match stored.as_ref().and_then(|stored| of_store(stored)) {
        Some(object) => (object, true),
        None => (make(arguments, &shard, reporter)?, false),
    };
    if let Some(stored) = stored.as_ref().filter(|_| !is_stored) {
        write(stored, &object, Replace::Always, reporter)?;
    }
    let is_new = write(output, &object, Replace::IfDifferent, reporter)?;
    depfile(arguments, &shard, output, reporter)?;
    if !arguments.sources.is_quiet() {
        let clips = console::counted(shard.inputs().len(), "clip");
        let done = match (is_stored, is_new) {
            (_, false) => "unchanged in",
            (true, true) => "taken from the store into",
            (false, true) => "packed into",
        };
        let (path, bytes) = (console::path(output), console::grouped(object.len()));
        reporter.summary(&format!("shard {number}: {clips} {done} {path} ({bytes} bytes)\n"))?;
    }
    Ok(Outcome::Clean)
}

/// Where the object goes.
fn output<'a>(arguments: &'a Pack, reporter: &mut Reporter) -> Result<&'a Path, Abort> {
    let Some(output) = arguments.output.as_deref().filter(|output| !stdio::is_meant(output)) else {
        return Err(reporter.usage("no object to write is named", "name a file with `--output`: 3-of-64.lipzobj"));
    };
    output_file::refuse_source(output, reporter)?;
    Ok(output)
}

/// An object of a store, if it is whole: a machine may have stopped while another program copied it there.
fn of_store(path: &Path) -> Option<Vec<u8>> {
    let object = fs::read(path).ok()?;
    Bank::open(&object).ok()?.verify().ok()?;
    Some(object)
}

fn write(path: &Path, bytes: &[u8], replace: Replace, reporter: &mut Reporter) -> Result<bool, Abort> {
    let written = interrupt::whole(|| OutputFile::write(path, bytes, replace));
    written.map(|file| file.is_new).map_err(|report| reporter.fail(report))
}

fn make(arguments: &Pack, plan: &ShardPlan, reporter: &mut Reporter) -> Result<Vec<u8>, Abort> {
    let changed = plan.changed();
    if !changed.is_empty() {
        return Err(reporter.refuse(changed));
    }
    let (settings, shown) = settings(plan, reporter)?;
    let inputs = plan.inputs();
    let (recordings, mut reports) = lipz_sync::in_bank(&settings, &inputs);
    let word_times = lipz_sync::word_times(&settings, &inputs).unwrap_or_else(|report| {
        reports.push(report);
        Default::default()
    });
    let mut options = settings.options.clone().recordings(recordings).word_times(word_times).voices(settings.voices());
    options.threads = arguments.sources.threads();
    let mut shard = Shard::new(plan.shard, plan.shards);
    (shard.settings, shard.reports) = (shown, reports);
    let bar = console::progress_bar(inputs.len(), arguments.sources.is_quiet());
    let compiler = Compiler::new(options).progress(|files| {
        bar.inc(files);
        interrupt::point();
    });
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

/// The settings of a plan, with path and contents of their file.
fn settings(plan: &ShardPlan, reporter: &mut Reporter) -> Result<(Settings, Option<(String, String)>), Abort> {
    let Some(file) = &plan.settings else { return Ok((Settings::default(), None)) };
    let (settings, report) = Settings::read(Path::new(&file.path));
    if report.has_errors() {
        return Err(reporter.refuse(vec![report]));
    }
    let text = fs::read_to_string(&file.path).map_err(|error| {
        let message = format!("`{}` cannot be read: {error}", file.path);
        reporter.fail(Report::failure(file.path.as_str(), Code::UnreadableFile, message, "make the plan again"))
    })?;
    Ok((settings, Some((file.path.clone(), text))))
}

/// Writes what the object depends on, if that was asked for. The plan itself is for the build engine to name.
fn depfile(arguments: &Pack, plan: &ShardPlan, output: &Path, reporter: &mut Reporter) -> Result<(), Abort> {
    let Some(path) = &arguments.depfile else { return Ok(()) };
    let needs: Vec<PathBuf> = plan.needs().map(PathBuf::from).collect();
    let bytes = lipz_compiler::depfile(output, &needs).map_err(|report| reporter.fail(report))?;
    write(path, &bytes, Replace::IfDifferent, reporter).map(drop)
}
