//! `lipz shard plan`: which files each shard of a project is made of.

use crate::commands::Run;
use crate::reporter::{Abort, Ended, Reporter};
use crate::shared::inputs;
use crate::shared::settings_file::SettingsFile;
use crate::shared::{output_file, stdio};
use crate::{Outcome, console, interrupt};
use clap::Args;
use lipz_compiler::settings::Settings;
use lipz_compiler::shard::{self, Beside, Common, MAX_SHARDS, Plan, Step};
use lipz_compiler::{Input, OutputFile, Replace, dependencies, depfile};
use lipz_sync::shard::{beside, record_hash};
use lipz_sync::{Recordings, SyncOptions, SyncRecord, jobs_of_clips, record_place};
use std::collections::HashMap;
use std::num::NonZero;
use std::path::{Path, PathBuf};

/// Write the plan of a project: which files each shard is made of, with the hashes of their contents.
///
/// A clip belongs to a shard by the top bits of its id, and stays in it when other clips come and go. All settings come from
/// lipz.toml: each step reads them there. Paths in the plan count from the current folder, in which the steps then run.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz shard plan voices --shards 64 -o plan.json
  lipz shard plan --shards 16 -o plan.json
  lipz shard plan --sync --shards 16 -o sync.json")]
pub(super) struct PlanArguments {
    /// Folders, files or glob patterns [default: those of lipz.toml]
    #[arg(value_name = "SOURCES")]
    sources: Vec<PathBuf>,

    #[command(flatten)]
    settings: SettingsFile,

    /// Keys are paths below this folder [default: `root` of lipz.toml, else each source folder]
    #[arg(long, value_name = "FOLDER")]
    root: Option<PathBuf>,

    /// How many shards; a power of two keeps the clips of each together when the number is doubled
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u16).range(1..=i64::from(MAX_SHARDS)))]
    shards: u16,

    /// The plan to write. The plans of the shards are written into a folder beside it, plan.shards of plan.json, and what
    /// it depends on into plan.json.d, for Make and Ninja
    #[arg(short, long, value_name = "PLAN")]
    output: PathBuf,

    /// Plan lip sync, with `lipz sync --plan`, instead of packing
    #[arg(long, conflicts_with = "bank")]
    sync: bool,

    /// The bank that the objects will be linked to [default: `output` of lipz.toml, else dialogue.lipzbank]
    #[arg(long, value_name = "BANK")]
    bank: Option<PathBuf>,

    /// Show no summary
    #[arg(short, long)]
    quiet: bool,
}

impl Run for PlanArguments {
    fn prints_result(&self) -> bool {
        false
    }

    fn run(&self, reporter: &mut Reporter) -> Ended {
        if stdio::is_meant(&self.output) {
            return Err(reporter.usage("a plan is several files", "name a file with `--output`: plan.json"));
        }
        output_file::refuse_source(&self.output, reporter)?;
        let mut project = self.settings.project(&self.sources, reporter)?;
        let settings = &mut project.settings;
        settings.root = self.root.clone().or(settings.root.take());
        if settings.sources.iter().any(|source| stdio::is_meant(source)) {
            return Err(reporter.usage("a plan is about files, not standard input", "name files or folders"));
        }
        let (found, reports) = inputs::find_all(settings, reporter)?;
        reporter.add(reports);
        if found.is_empty() {
            return Err(reporter.usage("there is nothing to plan", "name a folder of Lipz files"));
        }
        let makes = match self.sync {
            true => self.output.with_extension("done"),
            false => self.bank.clone().or(settings.output.clone()).unwrap_or_else(|| "dialogue.lipzbank".into()),
        };
        let needs = self.needs(settings, &found, reporter)?;
        let count = NonZero::new(self.shards).unwrap_or(NonZero::<u16>::MIN);
        let (file, voices) = (project.file.as_deref(), settings.voices());
        let common = Common { settings: file, record: &record_place(settings), files: &needs.common, voices: &voices };
        let step = if self.sync { Step::Sync } else { Step::Pack };
        let beside = |input: &Input| needs.beside.get(&input.key).cloned().unwrap_or_default();
        let shards = shard::plan(step, &found, count, common, beside);
        let shards = shards.map_err(|reports| reporter.abort(reports, Outcome::Failed))?;
        let folder = self.folder(reporter)?;
        let plan = Plan::new(&shards, &folder, &makes, made_by()).map_err(|report| reporter.fail(report))?;
        // The plan comes last: whoever finds it finds those of its shards.
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
        if !self.quiet {
            let clips = console::counted(found.len(), "clip");
            let shards = console::counted(plan.shards.len(), "shard");
            reporter.summary(&format!("{clips} planned in {shards} into {}\n", console::path(&self.output)))?;
        }
        Ok(Outcome::Clean)
    }
}

/// What steps read besides Lipz files and settings.
struct Needs {
    /// The record of mouths, if it is there.
    record: Option<PathBuf>,
    /// What all shards read.
    common: Vec<PathBuf>,
    /// What is read for each clip, by key.
    beside: HashMap<String, Beside>,
}

impl PlanArguments {
    fn needs(&self, settings: &Settings, found: &[Input], reporter: &mut Reporter) -> Result<Needs, Abort> {
        let (recordings, unread) = Recordings::discover_with_reports(settings);
        reporter.add(unread);
        let place = record_place(settings);
        let record = SyncRecord::read(&place).map_err(|report| reporter.fail(report))?;
        let place = Some(place).filter(|place| place.is_file());
        if !self.sync {
            let of_clip = |input: &Input| {
                let recording = recordings.find(&input.key).map(Path::to_owned);
                let beside = Beside { recording, record: record_hash(&record, input), files: Vec::new() };
                (input.key.clone(), beside)
            };
            return Ok(Needs { record: place, common: Vec::new(), beside: found.iter().map(of_clip).collect() });
        }
        let beside = beside(settings, found, &recordings, &record);
        if beside.is_empty() {
            let tip = "name their folder in [audio] of lipz.toml; keys are paths of Lipz files and of recordings";
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

    /// The folder of the plans of the shards, which is beside the plan: `plan.shards` of `plan.json`.
    fn folder(&self, reporter: &mut Reporter) -> Result<String, Abort> {
        let folder = self.output.with_extension("shards");
        let name = folder.file_name().and_then(|name| name.to_str()).map(str::to_owned);
        name.ok_or_else(|| reporter.usage("the name of the plan is not Unicode", "give the plan another name"))
    }
}

/// The arguments of this run: they make the plan again.
fn made_by() -> Vec<String> {
    std::env::args_os().skip(1).map(|argument| argument.to_string_lossy().into_owned()).collect()
}

/// Writes a plan. One that is the same stays, with its time: build engines see that nothing follows from it.
fn write(path: &Path, json: &str, reporter: &mut Reporter) -> Result<(), Abort> {
    let written = interrupt::whole(|| OutputFile::write(path, json.as_bytes(), Replace::IfDifferent));
    written.map(drop).map_err(|report| reporter.fail(report))
}
