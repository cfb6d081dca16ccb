//! `lipz shard plan`: assigns the files of a project to shards.

use crate::commands::Run;
use crate::reporter::{Abort, CommandResult, Reporter};
use crate::shared::inputs;
use crate::shared::run_flags::QuietFlag;
use crate::shared::settings_file::SettingsFile;
use crate::shared::{output_file, stdio};
use crate::{Outcome, console, interrupt};
use clap::{Args, ValueEnum};
use lipz_compiler::settings::Settings;
use lipz_compiler::shard::{self, CommonInputs, ExtraInputs, MAX_SHARDS, Plan, Step};
use lipz_compiler::{Input, OutputFile, Replace, dependencies, depfile};
use lipz_diagnostics::escape::quoted;
use lipz_sync::shard::{beside, record_hash};
use lipz_sync::{Recordings, SyncOptions, SyncRecord, jobs_of_clips, record_place};
use std::collections::HashMap;
use std::num::NonZero;
use std::path::{Path, PathBuf};

/// The settings that affect only the plan, not its steps.
const OF_PLAN: &[&str] = &["sources", "root", "hidden", "output"];

/// Write a plan: the files of each shard, with their hashes.
///
/// The shard of a clip depends only on the top bits of its ID, so a clip stays there when you add or remove others. Each
/// step reads the settings from lipz.toml. Paths in the plan are relative to the current folder, in which the steps run.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz shard plan pack voices --shards 64 -o plan.json
  lipz shard plan pack --shards 16 -o plan.json --config output=dialogue.lipzset
  lipz shard plan sync --shards 16 -o sync.json")]
pub(super) struct PlanArguments {
    /// Work to divide
    #[arg(value_enum, value_name = "STEP")]
    step: StepName,

    /// Folders, files or patterns [default: those of lipz.toml]
    #[arg(value_name = "SOURCES")]
    sources: Vec<PathBuf>,

    #[command(flatten)]
    settings: SettingsFile,

    /// Number of shards; a power of two keeps clips together when you double it
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u16).range(1..=i64::from(MAX_SHARDS)))]
    shards: u16,

    /// Plan to write
    ///
    /// The plans of the shards go into the folder plan.shards next to plan.json, and the dependencies of the plan into
    /// plan.json.d, for Make and Ninja.
    #[arg(short, long, value_name = "PLAN")]
    output: PathBuf,

    #[command(flatten)]
    quiet: QuietFlag,
}

/// The work that is divided into shards.
#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
enum StepName {
    /// Packing Lipz files
    Pack,
    /// Making visemes from recordings
    Sync,
}

impl From<StepName> for Step {
    fn from(name: StepName) -> Step {
        match name {
            StepName::Pack => Step::Pack,
            StepName::Sync => Step::Sync,
        }
    }
}

impl Run for PlanArguments {
    fn prints_result(&self) -> bool {
        false
    }

    fn run(&self, reporter: &mut Reporter) -> CommandResult {
        if stdio::is_meant(&self.output) {
            return Err(
                reporter.usage("a plan cannot be written to standard output", "name a file with `--output`: plan.json")
            );
        }
        output_file::refuse_source(&self.output, reporter)?;
        if let Some(setting) = self.settings.assigned().into_iter().find(|setting| !OF_PLAN.contains(setting)) {
            let message = format!("`--config` cannot set {} for the steps of a plan", quoted(setting));
            return Err(reporter.usage(message, "set it in lipz.toml, from which each step reads its settings"));
        }
        let mut project = self.settings.project(&self.sources, reporter)?;
        let settings = &mut project.settings;
        if settings.sources.iter().any(|source| stdio::is_meant(source)) {
            return Err(reporter.usage("a plan cannot contain standard input", "name files or folders"));
        }
        let (found, reports) = inputs::find_all(settings, reporter)?;
        reporter.add(reports);
        if found.is_empty() {
            return Err(reporter.usage("the sources do not contain Lipz files", "name a folder of Lipz files"));
        }
        let step = Step::from(self.step);
        let makes = match step == Step::Sync {
            true => self.output.with_extension("done"),
            false => settings.output.clone().unwrap_or_else(|| "dialogue.lipzbank".into()),
        };
        let needs = self.needs(settings, &found, reporter)?;
        let count = NonZero::new(self.shards).unwrap_or(NonZero::<u16>::MIN);
        let (file, voices) = (project.file.as_deref(), settings.voices());
        let common =
            CommonInputs { settings: file, record: &record_place(settings), files: &needs.common, voices: &voices };
        let beside = |input: &Input| needs.beside.get(&input.key).cloned().unwrap_or_default();
        let shards = shard::plan(step, &found, count, common, beside);
        let shards = shards.map_err(|reports| reporter.abort(reports, Outcome::Failed))?;
        let folder = self.folder(reporter)?;
        let plan = Plan::new(&shards, &folder, &makes, made_by()).map_err(|report| reporter.fail(report))?;
        // Write the plan last, so that a reader that finds it also finds those of its shards.
        for (planned, shard) in std::iter::zip(&plan.shards, &shards) {
            write(&self.output.with_file_name(&planned.needs), &shard.to_json(), reporter)?;
        }
        write(&self.output, &plan.to_json(), reporter)?;
        let mut files = dependencies(settings, &found).map_err(|report| reporter.fail(report))?;
        files.extend(common.settings.map(Path::to_owned));
        files.extend(needs.record.into_iter().chain(needs.common));
        files.extend(needs.beside.into_values().flat_map(|of_clip| of_clip.recording.into_iter().chain(of_clip.files)));
        files.sort_unstable();
        files.dedup();
        let bytes = depfile(&self.output, &files).map_err(|report| reporter.fail(report))?;
        let mut path = self.output.clone().into_os_string();
        path.push(".d");
        output_file::write(Path::new(&path), &bytes, reporter)?;
        if !self.quiet.is_set() {
            let clips = console::counted(found.len(), "clip");
            let shards = console::counted(plan.shards.len(), "shard");
            reporter.summary(&format!("plan of {clips} in {shards} written to {}\n", console::path(&self.output)))?;
        }
        Ok(Outcome::Clean)
    }
}

/// The inputs of steps besides Lipz files and settings.
struct Needs {
    /// The sync record, if it exists.
    record: Option<PathBuf>,
    /// Inputs of all shards.
    common: Vec<PathBuf>,
    /// Inputs of each clip, by key.
    beside: HashMap<String, ExtraInputs>,
}

impl PlanArguments {
    fn needs(&self, settings: &Settings, found: &[Input], reporter: &mut Reporter) -> Result<Needs, Abort> {
        let (recordings, unread) = Recordings::discover_with_reports(settings);
        reporter.add(unread);
        let place = record_place(settings);
        let record = SyncRecord::read(&place).map_err(|report| reporter.fail(report))?;
        let place = Some(place).filter(|place| place.is_file());
        if self.step == StepName::Pack {
            let of_clip = |input: &Input| {
                let recording = recordings.find(&input.key).map(Path::to_owned);
                let beside = ExtraInputs { recording, record: record_hash(&record, input), files: Vec::new() };
                (input.key.clone(), beside)
            };
            return Ok(Needs { record: place, common: Vec::new(), beside: found.iter().map(of_clip).collect() });
        }
        let beside = beside(settings, found, &recordings, &record);
        if beside.is_empty() {
            let tip = "set their folder in [audio] of lipz.toml; the path of each recording is the key of its clip";
            return Err(reporter.usage("no clip has a recording", tip));
        }
        let (options, _) = SyncOptions::new_with_report(settings).map_err(|report| reporter.fail(report))?;
        if let Some(path) = &settings.sync.model {
            options.check_model(path, &jobs_of_clips(found, &recordings)).map_err(|report| reporter.fail(report))?;
        }
        let sync = &settings.sync;
        let common = [&sync.lexicon, &sync.model, &sync.recogniser].into_iter().flatten().cloned().collect();
        Ok(Needs { record: place, common, beside })
    }

    /// Returns the folder of the shards' plans next to the plan: `plan.shards` for `plan.json`.
    fn folder(&self, reporter: &mut Reporter) -> Result<String, Abort> {
        let folder = self.output.with_extension("shards");
        let name = folder.file_name().and_then(|name| name.to_str()).map(str::to_owned);
        name.ok_or_else(|| reporter.usage("the name of the plan is not Unicode", "give the plan a different name"))
    }
}

/// Returns the arguments of this run, which make the plan again.
fn made_by() -> Vec<String> {
    std::env::args_os().skip(1).map(|argument| argument.to_string_lossy().into_owned()).collect()
}

/// Writes a plan. Leaves an unchanged file and its time, so that build engines skip the steps that depend on it.
fn write(path: &Path, json: &str, reporter: &mut Reporter) -> Result<(), Abort> {
    let written = interrupt::whole(|| OutputFile::write(path, json.as_bytes(), Replace::IfDifferent));
    written.map(drop).map_err(|report| reporter.fail(report))
}
