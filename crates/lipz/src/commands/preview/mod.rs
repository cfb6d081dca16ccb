//! `lipz preview`: serves a local page that shows, plays and edits the clips of a project.

mod assets;
mod characters;
mod clip;
mod draft;
mod export;
mod guard;
mod hearing;
mod http;
mod listing;
mod placed_diagnostic;
mod project_file;
mod server;
mod shared_version;
mod sprites;
mod version;

use crate::CommandResult;
use crate::commands::Run;
use crate::commands::watch::{Alarm, Scope};
use crate::reporter::{Abort, Reporter};
use crate::shared::audio_flag::AudioFlag;
use crate::shared::bank_or_sources::names_lipz_files;
use crate::shared::dialogue_files::DialogueFiles;
use crate::shared::output_file;
use crate::shared::settings_file::Project;
use crate::shared::sources::Sources;
use crate::shared::stdio;
use crate::{Outcome, console};
use clap::Args;
use export::ExportedPage;
use lipz_compiler::Stack;
use lipz_compiler::settings::Settings;
use lipz_diagnostics::Report;
use lipz_diagnostics::reports::have_errors;
use lipz_sync::Recordings;
use server::Preview;
use shared_version::SharedVersion;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use version::{PreviewMemory, Version};

/// The help of the sources, which cannot be standard input.
const SOURCES: &str = "Folders, files or patterns, or a bank [default: those of lipz.toml]";

/// Watch, play and edit clips in a browser.
///
/// Serves a page to this machine only. The page shows the bank that the sources pack to, and updates when a file changes.
/// Edits on the page are written into the Lipz files. A bank can be played, but not edited. Press Ctrl-C to stop.
#[derive(Args, Debug)]
#[command(mut_arg("sources", |sources| sources.help(SOURCES)))]
#[command(after_help = "Examples:
  lipz preview
  lipz preview voices --open
  lipz preview voices --read-only --port 8080
  lipz preview dialogue.lipzbank
  lipz preview dialogue.lipzset
  lipz preview 'dialogue.lipzbank+dialogue.*.lipztexts'
  lipz preview voices -o site")]
pub(crate) struct PreviewArguments {
    #[command(flatten)]
    sources: Sources,

    #[command(flatten)]
    audio: AudioFlag,

    /// Port of the server [default: any free port]
    #[arg(long, value_name = "PORT")]
    port: Option<u16>,

    /// Open the page in the browser
    #[arg(long)]
    open: bool,

    /// Do not change any file
    #[arg(long)]
    read_only: bool,

    /// Write a read-only page with banks and recordings into this folder, for any web server
    #[arg(short, long, value_name = "FOLDER", conflicts_with_all = ["port", "open", "read_only"])]
    output: Option<PathBuf>,
}

impl Run for PreviewArguments {
    fn prints_result(&self) -> bool {
        false
    }

    fn run(&self, reporter: &mut Reporter) -> CommandResult {
        match self.sources.paths() {
            [path] if !names_lipz_files(path) && !stdio::is_meant(path) => self.of_bank(path, reporter),
            paths if paths.iter().any(|path| stdio::is_meant(path)) => {
                Err(reporter.usage("standard input cannot be previewed", "name a folder, Lipz files or a bank"))
            }
            _ => self.of_sources(reporter),
        }
    }
}

impl PreviewArguments {
    /// Serves a bank, until the process is interrupted.
    fn of_bank(&self, path: &Path, reporter: &mut Reporter) -> CommandResult {
        self.sources.refuse_with_bank(path, reporter)?;
        let named = DialogueFiles::open(path, reporter)?;
        let bytes = whole(&named, reporter)?;
        let mut settings = Settings::default();
        self.audio.apply(&mut settings.audio, reporter)?;
        let (recordings, unread) = Recordings::discover_with_reports(&settings);
        if have_errors(&unread) {
            return Err(reporter.abort(unread, Outcome::Failed));
        }
        let version = Version::of_bank(&named.name, bytes, recordings);
        if let Some(folder) = &self.output {
            return export_to(folder, &version, self.sources.is_quiet(), reporter);
        }
        let shared = Arc::new(SharedVersion::new(version));
        let serving = self.serve(&shared, true, reporter)?;
        // The threads of the server end with the process.
        let _ = serving.join();
        Ok(Outcome::Clean)
    }

    /// Returns the project that the arguments name.
    fn project(&self, reporter: &mut Reporter) -> Result<Project, Abort> {
        let mut project = self.sources.project(reporter)?;
        self.audio.apply(&mut project.settings.audio, reporter)?;
        Ok(project)
    }

    /// Serves a project, and packs it again after each change of a file, until the process is interrupted.
    fn of_sources(&self, reporter: &mut Reporter) -> CommandResult {
        if let Some(folder) = &self.output {
            let project = self.project(reporter)?;
            let (version, _) = version::load(&project.settings, &mut PreviewMemory::default());
            return export_to(folder, &version, self.sources.is_quiet(), reporter);
        }
        let mut scope = Scope::before_settings(&self.sources);
        let mut alarm = Alarm::new(None);
        // Start before reading anything, so that no change is missed.
        alarm.set(&scope).map_err(|report| reporter.fail(report))?;
        let mut remembered = PreviewMemory::default();
        let mut shared: Option<Arc<SharedVersion>> = None;
        loop {
            match self.project(reporter) {
                Ok(project) => {
                    scope = Scope::new(&project, &self.sources).with_recordings();
                    alarm.set(&scope).map_err(|report| reporter.fail(report))?;
                    let (version, inputs) = version::load(&project.settings, &mut remembered);
                    let single = self.sources.names_single_files();
                    let shared = match &shared {
                        Some(shared) => {
                            shared.replace(version);
                            shared
                        }
                        None => {
                            let first = Arc::new(SharedVersion::new(version));
                            self.serve(&first, self.read_only, reporter)?;
                            shared.insert(first)
                        }
                    };
                    shared.look_closer(project, inputs, single);
                }
                Err(abort) if shared.is_none() => return Err(abort),
                // The settings have errors, which the page shows as well. Its content stays.
                Err(_) => {
                    let file = self.sources.settings_file().filter(|file| file.is_file());
                    let report = file.and_then(|file| Settings::read(file).err());
                    shared.iter().zip(&report).for_each(|(shared, report)| shared.tell(report));
                }
            }
            let state = scope.state();
            while !alarm.wait().is_certain {
                alarm.set(&scope).map_err(|report| reporter.fail(report))?;
                if scope.state() != state {
                    break;
                }
            }
        }
    }

    /// Starts the server, and prints the address of the page.
    fn serve(
        &self,
        shared: &Arc<SharedVersion>,
        is_read_only: bool,
        reporter: &mut Reporter,
    ) -> Result<std::thread::JoinHandle<()>, Abort> {
        let server = Preview::listen(self.port, Arc::clone(shared), is_read_only).map_err(|error| {
            reporter.usage(format!("the page cannot be served: {error}"), "name a different port with `--port`")
        })?;
        let address = server.address();
        reporter.summary(&format!("{address}\n"))?;
        reporter.remark("          do not share this address; press Ctrl-C to stop\n");
        if self.open
            && let Err(error) = open::that_detached(&address)
        {
            reporter
                .remark(&format!("          the browser could not be started ({error}); open the address yourself\n"));
        }
        std::thread::Builder::new().spawn(move || server.run()).map_err(|error| {
            reporter.usage(format!("the page cannot be served: {error}"), "raise the limits of the system")
        })
    }
}

/// Returns a single verified bank with the contents of these files.
fn whole(named: &DialogueFiles, reporter: &mut Reporter) -> Result<Vec<u8>, Abort> {
    let files = named.verified(reporter)?;
    let dialogue = named.dialogue(&files, reporter)?;
    match named.bytes() {
        Some(bytes) => Ok(bytes.to_vec()),
        None => Stack::of(&named.name, &dialogue).map(Stack::into_bank).map_err(|report| reporter.fail(report)),
    }
}

/// Writes the page into a folder, and reports diagnostics. It lists files with errors, but its bank does not contain
/// them.
fn export_to(folder: &Path, version: &Version, is_quiet: bool, reporter: &mut Reporter) -> CommandResult {
    output_file::refuse_file(folder, reporter)?;
    if !export::is_free(folder) {
        let message = format!("`{}` contains files that do not belong to an exported page", console::path(folder));
        return Err(reporter.usage(message, "name a folder that is empty or does not exist"));
    }
    let mut reports = version.all_reports();
    let bar = console::progress_bar(version.files.len(), is_quiet);
    let (phones, unheard) = version.hearing.all(version, &|| bar.inc(1));
    bar.finish_and_clear();
    reports.extend_from_slice(&unheard);
    let outcome = Outcome::from_reports(&reports);
    reporter.add(reports);
    if outcome == Outcome::Failed || version.bank.is_empty() {
        let message = "the page is not written, because the bank could not be packed";
        return Err(reporter.usage(message, "fix the errors, or name different sources"));
    }
    let ExportedPage { clips, sounds, left_out } =
        export::export(version, &phones, folder).map_err(|reports| reporter.abort(reports, Outcome::Failed))?;
    let outcome = outcome.max(Outcome::from_reports(&left_out));
    // A recording that cannot be read has been reported with its phones.
    let is_reported = |report: &Report| unheard.iter().any(|known| known.source.path == report.source.path);
    reporter.add(left_out.into_iter().filter(|report| !is_reported(report)).collect());
    let counts = format!("{}, {}", console::counted(clips, "clip"), console::counted(sounds, "recording"));
    reporter.summary(&format!("{}: {counts}\n", console::path(&folder.join("index.html"))))?;
    Ok(outcome)
}
