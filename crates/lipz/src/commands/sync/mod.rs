//! `lipz sync`: mouth shapes from recordings.

mod flags;
mod merging;
mod shard;
mod summary;
mod table;
mod train;

use crate::commands::Run;
use crate::reporter::{Abort, Ended, Reporter};
use crate::shared::audio_flags::AudioFlags;
use crate::shared::inputs;
use crate::shared::output_file;
use crate::shared::project_flags::{hide_of_banks, parse_fps};
use crate::shared::sources::Sources;
use crate::shared::{formats, patterns, script_file, stdio};
use crate::{Outcome, console, interrupt};
use clap::{Arg, Args};
use flags::SyncFlags;
use lipz_bank::Fps;
use lipz_compiler::settings::Settings;
use lipz_diagnostics::{Code, Report};
use lipz_interop::Encoding;
use lipz_sync::{
    JOB_PARTS, Job, Recordings, SyncOptions, SyncRecord, SyncRun, jobs_of_clips, jobs_of_recordings_with_reports,
};
use std::path::{Path, PathBuf};

/// Make mouth shapes from recordings.
///
/// With --audio (or `[audio]` in lipz.toml), Lipz files get the mouths of their recordings: only `visemes`, `viseme_type`
/// and `fps` change, and the `|` move with the words of the text. With --output, recordings become Lipz files; what is
/// said stands in a script, or in NAME.txt beside each recording.
///
/// A second run makes only what changed. Mouths that were changed by hand stay, unless --force is given.
#[derive(Args, Debug)]
#[command(mut_args(of_mouths))]
#[command(after_help = "Examples:
  lipz sync
  lipz sync voices --audio recordings
  lipz sync voices/act1/mara-hello.lipz --audio recordings --root voices --force
  lipz sync recordings -o voices --script lines.csv --audio-locale en-us
  lipz sync --train --model voices.lipzmodel
  lipz sync --plan sync.json --shard 3 -o 3-of-64.lipzmouths
  lipz sync --from '*-of-64.lipzmouths'
  lipz sync recordings -o voices --viseme-type rms")]
pub(crate) struct SyncArguments {
    #[command(flatten)]
    sources: Sources,

    #[command(flatten)]
    audio: AudioFlags,

    #[command(flatten)]
    mouths: SyncFlags,

    /// Make Lipz files in this folder: the sources are recordings then
    #[arg(short, long, value_name = "FOLDER")]
    output: Option<PathBuf>,

    /// Texts of new files: a CSV string table with the columns `file` and `text`, or a .msg file of Fallout [default:
    /// NAME.txt beside NAME.wav]
    #[arg(long, value_name = "FILE", requires = "output")]
    script: Option<PathBuf>,

    /// The encoding of a script that is not UTF-8: windows-1251, shift_jis [default: windows-1252]
    #[arg(long, value_name = "NAME", requires = "script", value_parser = formats::encoding)]
    encoding: Option<&'static Encoding>,

    /// Frame rate of the mouths [default: that of each file, or default-fps, or 24]
    #[arg(long, value_name = "FPS", value_parser = parse_fps)]
    fps: Option<Fps>,

    /// Learn a model of these voices first, from the recordings and their texts; write it to --model and use it
    #[arg(long)]
    train: bool,

    /// Write a CSV table of all words to look at, those of unchanged clips too: doubtful ones, and those pronounced by rules;
    /// `-` is standard output
    #[arg(long, value_name = "FILE")]
    list: Option<PathBuf>,

    /// Also replace mouths that were made or changed by hand
    #[arg(long)]
    force: bool,

    /// Make the mouths of this shard of --plan, in the file --output: nothing else is written
    #[arg(long, value_name = "NUMBER", requires = "plan", conflicts_with_all = OF_PLAN, help_heading = SHARDS)]
    shard: Option<u16>,

    /// The plan of the shards, by `lipz shard plan --sync`. It names Lipz files, recordings and settings
    #[arg(long, value_name = "PLAN", requires = "shard", help_heading = SHARDS)]
    plan: Option<PathBuf>,

    /// Folder of results by the hashes of what they are made of: what is in it is not made again
    #[arg(long, value_name = "FOLDER", requires = "shard", help_heading = SHARDS)]
    store: Option<PathBuf>,

    /// Also write the dependencies of the result, for Make, Ninja and CMake
    #[arg(long, value_name = "FILE", requires = "shard", help_heading = SHARDS)]
    depfile: Option<PathBuf>,

    /// Merge the mouths of all shards into the Lipz files: names or patterns of what --shard made
    #[arg(long, value_name = "FILES", num_args = 1.., conflicts_with_all = OF_PLAN, conflicts_with = "shard")]
    #[arg(help_heading = SHARDS)]
    from: Vec<PathBuf>,
}

const SHARDS: &str = "Shards";

/// What a plan decides.
const OF_PLAN: [&str; 17] = [
    "sources",
    "root",
    "hidden",
    "ProjectFlags",
    "allow",
    "warn",
    "deny",
    "config",
    "no_config",
    "AudioFlags",
    "SyncFlags",
    "script",
    "encoding",
    "fps",
    "train",
    "list",
    "force",
];

/// Flags of others that have nothing to do with mouths, by their fields. They are accepted, as the settings are.
const OF_OTHERS: [&str; 10] = [
    "max_line_columns",
    "max_lines",
    "max_characters_per_second",
    "characters",
    "props",
    "emotions",
    "actions",
    "tolerance_ms",
    "audio_cache",
    "in_bank",
];

/// Flags that this command shares with others, as it means them.
fn of_mouths(flag: Arg) -> Arg {
    match flag.get_id().as_str() {
        "sources" => flag.help(
            "Lipz files, or with --output recordings: folders, files or glob patterns [default: those of lipz.toml]",
        ),
        "viseme_type" => {
            flag.help("Viseme type of the mouths [default: that of each file, or default-viseme-type, or blair]")
        }
        name if OF_OTHERS.contains(&name) => flag.hide(true),
        _ => hide_of_banks(flag),
    }
}

/// What a run works on.
struct Work {
    jobs: Vec<Job>,
    reports: Vec<Report>,
    /// Clips without a recording.
    without: usize,
    /// Where the Lipz files are.
    place: PathBuf,
}

impl Run for SyncArguments {
    fn prints_result(&self) -> bool {
        self.list.as_deref().is_some_and(stdio::is_meant)
    }

    fn run(&self, reporter: &mut Reporter) -> Ended {
        if let (Some(shard), Some(plan)) = (self.shard, &self.plan) {
            return shard::run(self, shard, plan, reporter);
        }
        if !self.from.is_empty() {
            return merging::run(self, reporter);
        }
        let mut project = self.sources.project(reporter)?;
        let settings = &mut project.settings;
        self.audio.apply(&mut settings.audio);
        self.mouths.apply(&mut settings.sync);
        if settings.sources.iter().any(|source| stdio::is_meant(source)) {
            return Err(reporter.usage("mouths are not made of standard input", "name files or folders"));
        }
        if let Some(file) = self.output.as_ref().filter(|output| output.is_file()) {
            let message = format!("`{}` is a file", console::path(file));
            return Err(reporter.usage(message, "name a folder with `--output`: each recording becomes a file in it"));
        }
        let work = match &self.output {
            Some(output) => self.of_recordings(settings, output, reporter)?,
            None => of_clips(settings, reporter)?,
        };
        let to_train = if self.train { Some(train::place(settings, reporter)?) } else { None };
        let (mut options, problems) = SyncOptions::new_with_report(settings).map_err(|report| reporter.fail(report))?;
        (options.fps, options.force) = (self.fps, self.force);
        if options.locale.is_none() && work.jobs.iter().any(|job| job.text.is_some() && job.locale.is_none()) {
            let tip = "name it with `--audio-locale`, or set `default-locale` in lipz.toml: texts become `text_LOCALE` of the Lipz files";
            return Err(reporter.usage("no locale of the texts is named", tip));
        }
        let learnt = match &to_train {
            Some(place) => Some(train::train(&work.jobs, &mut options, place, self.sources.is_quiet(), reporter)?),
            None => None,
        };
        if let Some(path) = &settings.sync.model {
            options.check_model(path, &work.jobs).map_err(|report| reporter.fail(report))?;
        }
        let beside = || SyncRecord::place(&work.place);
        let place = settings.audio.record.clone().unwrap_or_else(beside);
        let record = SyncRecord::read(&place).map_err(|report| reporter.fail(report))?;
        let mut of_record = record.warnings().to_vec();
        of_record.iter_mut().for_each(|report| settings.options.get_levels().apply(&mut report.diagnostics));
        let bar = console::progress_bar_of_parts(work.jobs.len(), JOB_PARTS.into(), self.sources.is_quiet());
        let run = SyncRun::of_jobs(work.jobs, options, record).progress(|parts| bar.inc(parts.into()));
        let mut synced = run.around_writes(|write| interrupt::whole(write)).run();
        bar.finish_and_clear();
        let mut reports = work.reports;
        if let Some(path) = self.list.as_deref().filter(|path| !stdio::is_meant(path)) {
            output_file::refuse_source(path, reporter)?;
            let table = table::csv(&synced);
            let written = interrupt::whole(|| lipz_compiler::replace_file(path, table.as_bytes()));
            reports.extend(written.err());
        }
        reports.extend(problems.into_iter().chain(of_record).chain(std::mem::take(&mut synced.reports)));
        lipz_diagnostics::reports::sort(&mut reports);
        let outcome = Outcome::from_reports(&reports);
        reporter.add(reports);
        reporter.add_result("sync", || table::Table::new(&synced, work.without));
        if self.prints_result() {
            reporter.print(&table::csv(&synced))?;
        }
        if !self.sources.is_quiet() {
            reporter.summary(&learnt.unwrap_or_default())?;
            reporter.summary(&summary::summary(&synced, work.without, &work.place))?;
        }
        Ok(outcome)
    }
}

impl SyncArguments {
    /// Recordings become Lipz files in `output`.
    fn of_recordings(&self, settings: &Settings, output: &Path, reporter: &mut Reporter) -> Result<Work, Abort> {
        let script = match &self.script {
            Some(path) => Some(script_file::read(path, self.encoding, reporter)?),
            None => None,
        };
        let mut recordings = settings.clone();
        recordings.sources = patterns::files(&settings.sources);
        let (jobs, mut reports) = jobs_of_recordings_with_reports(&recordings, output, script.as_ref());
        reports.iter_mut().for_each(|report| settings.options.get_levels().apply(&mut report.diagnostics));
        if jobs.is_empty() && lipz_diagnostics::reports::have_errors(&reports) {
            return Err(reporter.abort(reports, Outcome::Failed));
        }
        Ok(Work { jobs, reports, without: 0, place: output.to_owned() })
    }
}

/// Lipz files get the mouths of their recordings.
fn of_clips(settings: &Settings, reporter: &mut Reporter) -> Result<Work, Abort> {
    let Some(folder) = &settings.audio.folder else {
        let tip =
            "name their folder with `--audio`, or set `folder` in [audio]; `--output` makes Lipz files of recordings";
        return Err(reporter.usage("no recordings are named", tip));
    };
    let (recordings, mut reports) = Recordings::discover_with_reports(settings);
    if lipz_diagnostics::reports::have_errors(&reports) {
        return Err(reporter.abort(reports, Outcome::Failed));
    }
    let (inputs, unread) = inputs::find(settings);
    reports.extend(unread);
    if inputs.is_empty() && lipz_diagnostics::reports::have_errors(&reports) {
        let none = reports.iter_mut().flat_map(|report| &mut report.diagnostics);
        let first = "to make the first Lipz files of recordings: lipz sync recordings -o voices";
        none.filter(|none| none.code == Code::NoSources).for_each(|none| none.help = Some(first.to_owned()));
        return Err(reporter.abort(reports, Outcome::Failed));
    }
    let jobs = jobs_of_clips(&inputs, &recordings);
    if jobs.is_empty() && !inputs.is_empty() {
        let tip =
            "keys are paths of Lipz files below `--root`, and of recordings below `--audio`: both must be the same";
        let message = format!("no clip has a recording in `{}`", console::path(folder));
        return Err(reporter.usage(message, tip));
    }
    let first = settings.sources.first().map(PathBuf::as_path);
    let folder = |path: &Path| path.ancestors().find(|path| path.is_dir()).map(Path::to_owned);
    let place = settings.root.clone().or_else(|| folder(first?)).unwrap_or_else(|| PathBuf::from("."));
    let without = inputs.iter().filter(|input| recordings.find(&input.key).is_none()).count();
    Ok(Work { without, jobs, reports, place })
}
