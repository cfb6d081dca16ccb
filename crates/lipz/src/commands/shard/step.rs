//! The common parts of shard steps: reading a plan, and writing a result, also to a store.

use crate::reporter::{Abort, Reporter};
use crate::shared::input_file::unreadable;
use crate::shared::run_flags::{JobsFlag, QuietFlag};
use crate::shared::{output_file, stdio};
use crate::{console, interrupt};
use clap::Args;
use lipz_compiler::settings::Settings;
use lipz_compiler::shard::{Plan, ShardPlan, Step};
use lipz_compiler::{OutputFile, Replace};
use std::fs;
use std::path::{Path, PathBuf};

/// The step of one shard.
#[derive(Args, Debug)]
pub(super) struct StepArguments {
    /// Plan, written by `lipz shard plan`
    #[arg(value_name = "PLAN")]
    pub(super) plan: PathBuf,

    /// Number of the shard, from 0
    #[arg(value_name = "SHARD")]
    pub(super) shard: u16,

    /// File to write
    #[arg(short, long, value_name = "FILE")]
    pub(super) output: PathBuf,

    /// Folder that stores results by the hash of their inputs, for reuse
    #[arg(long, value_name = "FOLDER")]
    pub(super) store: Option<PathBuf>,

    /// Write the dependencies of the result to FILE, for Make, Ninja and CMake
    #[arg(long, value_name = "FILE")]
    pub(super) depfile: Option<PathBuf>,

    #[command(flatten)]
    pub(super) jobs: JobsFlag,

    #[command(flatten)]
    pub(super) quiet: QuietFlag,
}

/// Opens the plan of shard `number` from the plan at `path`, for the result in `output`.
pub(super) fn open(
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
            Step::Pack => ("packing", "lipz shard pack"),
            Step::Sync => ("lip sync", "lipz shard sync"),
        };
        let message = format!("`{}` is a plan of {what}", console::path(path));
        return Err(reporter.usage(message, &format!("use `{command}`")));
    }
    let Some(shard) = plan.shards.get(usize::from(number)) else {
        let shards = console::counted(plan.shards.len(), "shard");
        let tip = format!("choose a number from 0 to {}", plan.shards.len().saturating_sub(1));
        return Err(reporter.usage(format!("shard {number} is not in the plan, which has {shards}"), &tip));
    };
    plan.read_shard(shard, path).map_err(|report| reporter.refuse(vec![report]))
}

/// Returns the path of the result.
pub(super) fn output<'a>(output: &'a Path, example: &str, reporter: &mut Reporter) -> Result<&'a Path, Abort> {
    if stdio::is_meant(output) {
        let tip = format!("name a file with `--output`: {example}");
        return Err(reporter.usage("the result of a shard cannot be written to standard output", &tip));
    }
    output_file::refuse_source(output, reporter)?;
    Ok(output)
}

/// Returns the settings of a plan, with the path and the contents of their file.
pub(super) fn settings(
    plan: &ShardPlan,
    reporter: &mut Reporter,
) -> Result<(Settings, Option<(String, String)>), Abort> {
    let Some(file) = &plan.settings else { return Ok((Settings::default(), None)) };
    let settings = Settings::read(&file.path).map_err(|report| reporter.refuse(vec![report]))?;
    let read = fs::read_to_string(&file.path);
    let text = read.map_err(|error| reporter.fail(unreadable(Path::new(&file.path), &error)))?;
    Ok((settings, Some((file.path.clone(), text))))
}

/// Writes a result, and returns whether it differs from the previous one.
pub(super) fn write(path: &Path, bytes: &[u8], replace: Replace, reporter: &mut Reporter) -> Result<bool, Abort> {
    let written = interrupt::whole(|| OutputFile::write(path, bytes, replace));
    written.map(|file| file.is_new).map_err(|report| reporter.fail(report))
}

/// Writes the dependencies of the result, if requested. The plan itself is left to the build engine.
pub(super) fn depfile(
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

/// Describes the result for people.
pub(super) fn done(is_stored: bool, is_new: bool, made: &'static str) -> &'static str {
    match (is_stored, is_new) {
        (_, false) => "unchanged in",
        (true, true) => "copied from the store to",
        (false, true) => made,
    }
}
