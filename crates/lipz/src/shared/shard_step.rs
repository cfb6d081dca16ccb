//! What the steps of shards have in common: a plan is read, and a result is written, also into a store.

use crate::reporter::{Abort, Reporter};
use crate::shared::{output_file, stdio};
use crate::{console, interrupt};
use lipz_compiler::settings::Settings;
use lipz_compiler::shard::{Plan, ShardPlan, Step};
use lipz_compiler::{OutputFile, Replace};
use lipz_diagnostics::{Code, Report};
use std::fs;
use std::path::{Path, PathBuf};

/// The plan of shard `number` of the plan in the file `path`, whose result will be in `output`.
pub(crate) fn open(
    path: &Path,
    number: u16,
    step: Step,
    output: &Path,
    reporter: &mut Reporter,
) -> Result<ShardPlan, Abort> {
    output_file::refuse_same(&[("the plan", path), ("the result", output)], reporter)?;
    let plan = Plan::read(path).map_err(|report| reporter.refuse(vec![report]))?;
    if plan.step != step {
        let (what, command) = match plan.step {
            Step::Pack => ("packing", "lipz pack --plan"),
            Step::Sync => ("lip sync", "lipz sync --plan"),
        };
        let message = format!("`{}` is a plan of {what}", console::path(path));
        return Err(reporter.usage(message, &format!("its steps are: {command}")));
    }
    let Some(shard) = plan.shards.get(usize::from(number)) else {
        let shards = console::counted(plan.shards.len(), "shard");
        return Err(reporter.usage(format!("there is no shard {number}: the plan has {shards}"), "they count from 0"));
    };
    plan.read_shard(shard, path).map_err(|report| reporter.refuse(vec![report]))
}

/// Where the result goes.
pub(crate) fn output<'a>(output: Option<&'a Path>, example: &str, reporter: &mut Reporter) -> Result<&'a Path, Abort> {
    let Some(output) = output.filter(|output| !stdio::is_meant(output)) else {
        return Err(reporter.usage("no result to write is named", &format!("name a file with `--output`: {example}")));
    };
    output_file::refuse_source(output, reporter)?;
    Ok(output)
}

/// The settings of a plan, with path and contents of their file.
pub(crate) fn settings(
    plan: &ShardPlan,
    reporter: &mut Reporter,
) -> Result<(Settings, Option<(String, String)>), Abort> {
    let Some(file) = &plan.settings else { return Ok((Settings::default(), None)) };
    let settings = Settings::read(&file.path).map_err(|report| reporter.refuse(vec![report]))?;
    let text = fs::read_to_string(&file.path).map_err(|error| {
        let message = format!("`{}` cannot be read: {error}", file.path);
        reporter.fail(Report::failure(file.path.as_str(), Code::UnreadableFile, message, "make the plan again"))
    })?;
    Ok((settings, Some((file.path.clone(), text))))
}

/// Writes a result; whether there was another one before.
pub(crate) fn write(path: &Path, bytes: &[u8], replace: Replace, reporter: &mut Reporter) -> Result<bool, Abort> {
    let written = interrupt::whole(|| OutputFile::write(path, bytes, replace));
    written.map(|file| file.is_new).map_err(|report| reporter.fail(report))
}

/// Writes what the result depends on, if that was asked for. The plan itself is for the build engine to name.
pub(crate) fn depfile(
    path: Option<&Path>,
    plan: &ShardPlan,
    output: &Path,
    reporter: &mut Reporter,
) -> Result<(), Abort> {
    let Some(path) = path else { return Ok(()) };
    let needs: Vec<PathBuf> = plan.needs().map(PathBuf::from).collect();
    let bytes = lipz_compiler::depfile(output, &needs).map_err(|report| reporter.fail(report))?;
    write(path, &bytes, Replace::IfDifferent, reporter).map(drop)
}

/// What was done, for people.
pub(crate) fn done(is_stored: bool, is_new: bool, made: &'static str) -> &'static str {
    match (is_stored, is_new) {
        (_, false) => "unchanged in",
        (true, true) => "taken from the store into",
        (false, true) => made,
    }
}
