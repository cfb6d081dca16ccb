//! `lipz sync`: makes visemes from recordings.

mod train;

use crate::commands::Run;
use crate::reporter::{Abort, CommandResult, Reporter};
use crate::shared::audio_flag::AudioFlag;
use crate::shared::inputs;
use crate::shared::output_file;
use crate::shared::sources::Sources;
use crate::shared::values::{parse_fps, parse_viseme_type};
use crate::shared::{formats, patterns, script_file, stdio};
use crate::shared::{sync_summary, sync_table};
use crate::{Outcome, console, interrupt};
use clap::{Arg, Args};
use lipz_bank::{Fps, VisemeType};
use lipz_compiler::settings::Settings;
use lipz_diagnostics::{Code, Report};
use lipz_interop::Encoding;
use lipz_sync::{
    JOB_PARTS, Job, Recordings, SyncOptions, SyncRecord, SyncRun, jobs_of_clips, jobs_of_recordings_with_reports,
};
use std::path::{Path, PathBuf};

/// Make visemes from recordings.
///
/// Lipz files get the visemes of their recordings, from the folder of --audio or of [audio] in lipz.toml. Only `visemes`,
/// `viseme_type` and `fps` change, and each `|` moves with the words of the text. --output makes new Lipz files from
/// recordings. Their transcripts come from a script, or from NAME.txt next to NAME.wav.
///
/// Later runs process only changed recordings and texts. Hand-edited visemes stay, unless you pass --discard-edits. [sync] of
/// lipz.toml contains the settings of visemes, voice models and lexicons.
#[derive(Args, Debug)]
#[command(mut_args(with_recordings))]
#[command(after_help = "Examples:
  lipz sync
  lipz sync voices --audio recordings
  lipz sync voices/act1/mara-hello.lipz --audio recordings --discard-edits
  lipz sync recordings -o voices --script lines.csv --config audio.locale=en-us
  lipz sync --train --config sync.model=voices.lipzmodel
  lipz sync recordings -o voices --viseme-type rms")]
pub(crate) struct SyncArguments {
    #[command(flatten)]
    sources: Sources,

    #[command(flatten)]
    audio: AudioFlag,

    /// Make new Lipz files in this folder; the sources are recordings
    #[arg(short, long, value_name = "FOLDER")]
    output: Option<PathBuf>,

    /// Transcripts: a CSV table with columns `file` and `text`, or a .msg file [default: NAME.txt next to NAME.wav]
    #[arg(long, value_name = "FILE", requires = "output")]
    script: Option<PathBuf>,

    /// Encoding of a script that is not UTF-8, such as shift_jis [default: windows-1252]
    #[arg(long, value_name = "NAME", requires = "script", value_parser = formats::encoding)]
    encoding: Option<&'static Encoding>,

    /// Frame rate [default: that of each file or of lipz.toml, or 24]
    #[arg(long, value_name = "FPS", value_parser = parse_fps)]
    fps: Option<Fps>,

    /// Viseme type: blair, toonboom, rms [default: that of each file or of lipz.toml, or blair]
    #[arg(long, value_name = "TYPE", value_parser = parse_viseme_type)]
    viseme_type: Option<VisemeType>,

    /// Train a model of these voices first, and write it to `model` of [sync]
    #[arg(long)]
    train: bool,

    /// Write a CSV table of the clips and words to review, including unchanged clips; `-` is standard output
    #[arg(long, value_name = "FILE")]
    list: Option<PathBuf>,

    /// Replace handmade and hand-edited visemes
    #[arg(long)]
    discard_edits: bool,
}

/// Names the sources, which are recordings if `--output` is used.
fn with_recordings(flag: Arg) -> Arg {
    match flag.get_id().as_str() {
        "sources" => flag
            .help("Lipz files, or with --output recordings: folders, files or patterns [default: those of lipz.toml]"),
        _ => flag,
    }
}

/// The input of a run.
struct Work {
    jobs: Vec<Job>,
    reports: Vec<Report>,
    /// The number of clips without a recording.
    without: usize,
    /// The folder of the Lipz files.
    place: PathBuf,
}

impl Run for SyncArguments {
    fn prints_result(&self) -> bool {
        self.list.as_deref().is_some_and(stdio::is_meant)
    }

    fn run(&self, reporter: &mut Reporter) -> CommandResult {
        let mut project = self.sources.project(reporter)?;
        let settings = &mut project.settings;
        self.audio.apply(&mut settings.audio, reporter)?;
        let options = &mut settings.options;
        *options = std::mem::take(options).viseme_type(self.viseme_type.or(options.get_viseme_type()));
        if settings.sources.iter().any(|source| stdio::is_meant(source)) {
            return Err(reporter.usage("visemes cannot be made from standard input", "name files or folders"));
        }
        if let Some(file) = self.output.as_ref().filter(|output| output.is_file()) {
            let message = format!("`{}` is a file", console::path(file));
            return Err(
                reporter.usage(message, "name a folder with `--output`, in which each recording becomes a file")
            );
        }
        let work = match &self.output {
            Some(output) => self.of_recordings(settings, output, reporter)?,
            None => of_clips(settings, reporter)?,
        };
        let to_train = if self.train { Some(train::place(settings, reporter)?) } else { None };
        let (mut options, problems) = SyncOptions::new_with_report(settings).map_err(|report| reporter.fail(report))?;
        (options.fps, options.force) = (self.fps, self.discard_edits);
        if options.locale.is_none() && work.jobs.iter().any(|job| job.text.is_some() && job.locale.is_none()) {
            let tip = "set `default-locale` in lipz.toml, or `locale` in [audio]";
            return Err(reporter.usage("the locale of the texts is not set", tip));
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
            let table = sync_table::csv(&synced);
            let written = interrupt::whole(|| lipz_compiler::replace_file(path, table.as_bytes()));
            reports.extend(written.err());
        }
        reports.extend(problems.into_iter().chain(of_record).chain(std::mem::take(&mut synced.reports)));
        lipz_diagnostics::reports::sort(&mut reports);
        let outcome = Outcome::from_reports(&reports);
        reporter.add(reports);
        reporter.add_result("sync", || sync_table::SyncDocument::new(&synced, work.without));
        if self.prints_result() {
            reporter.print(&sync_table::csv(&synced))?;
        }
        if !self.sources.is_quiet() {
            reporter.summary(&learnt.unwrap_or_default())?;
            reporter.summary(&sync_summary::summary(&synced, work.without, &work.place))?;
        }
        Ok(outcome)
    }
}

impl SyncArguments {
    /// Plans Lipz files in `output` for recordings.
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

/// Plans visemes for Lipz files from their recordings.
fn of_clips(settings: &Settings, reporter: &mut Reporter) -> Result<Work, Abort> {
    let Some(folder) = &settings.audio.folder else {
        let tip = "name their folder with `--audio`, or set `folder` in [audio]; to make Lipz files from recordings, pass `--output`";
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
        let first = "make the first Lipz files from recordings: lipz sync recordings -o voices";
        none.filter(|none| none.code == Code::NoSources).for_each(|none| none.help = Some(first.to_owned()));
        return Err(reporter.abort(reports, Outcome::Failed));
    }
    let jobs = jobs_of_clips(&inputs, &recordings);
    if jobs.is_empty() && !inputs.is_empty() {
        let tip = "give each recording the key of its clip as its path below `--audio`";
        let message = format!("no clip has a recording in `{}`", console::path(folder));
        return Err(reporter.usage(message, tip));
    }
    let first = settings.sources.first().map(PathBuf::as_path);
    let folder = |path: &Path| path.ancestors().find(|path| path.is_dir()).map(Path::to_owned);
    let place = settings.root.clone().or_else(|| folder(first?)).unwrap_or_else(|| PathBuf::from("."));
    let without = inputs.iter().filter(|input| recordings.find(&input.key).is_none()).count();
    Ok(Work { without, jobs, reports, place })
}
