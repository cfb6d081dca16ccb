//! `lipz import recordings`: copies the takes that a director chose into the folder of recordings.

mod takes;

use crate::commands::Run;
use crate::commands::import::incoming_texts::IncomingTexts;
use crate::console;
use crate::interrupt::Files;
use crate::reporter::{CommandResult, Reporter};
use crate::shared::input_file::{read, unreadable};
use crate::shared::inputs::find_all;
use crate::shared::run_flags::QuietFlag;
use crate::shared::settings_file::SettingsFile;
use crate::shared::stdin_file::StdinFile;
use crate::shared::translations::{locales_of, source_locale};
use crate::shared::values::{parse_locale, refuse_locales};
use clap::Args;
use lipz_compiler::settings::Settings;
use lipz_diagnostics::{Code, Diagnostic, Report, escape, reports::have_errors};
use lipz_sync::Recordings;
use lipz_texts::{ChosenTake, ReadOptions};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use takes::TakeFiles;

/// Copy the chosen takes of a recording script into the folder of recordings.
///
/// The column `take` of the script, which `lipz export recording-script` writes, has the number of a take or the name of its
/// file. Either all takes are copied, or none.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz import recordings script.xlsx takes
  lipz import recordings pick-ups.csv monday --overwrite")]
pub(crate) struct ImportRecordings {
    /// Recording script: .xlsx, .csv, .tsv, .ods; `-` is standard input
    #[arg(value_name = "SCRIPT")]
    script: PathBuf,

    /// Folder with the takes of the session
    #[arg(value_name = "TAKES")]
    takes: PathBuf,

    /// Lipz files of the project: folders, files or patterns [default: those of lipz.toml]
    #[arg(short, long, value_name = "SOURCES")]
    output: Vec<PathBuf>,

    /// Spoken locale [default: that of the column with translations]
    #[arg(long, value_name = "LOCALE", value_parser = parse_locale)]
    locale: Option<String>,

    /// Replace existing recordings
    #[arg(long)]
    overwrite: bool,

    #[command(flatten)]
    file: SettingsFile,

    #[command(flatten)]
    stdin: StdinFile,

    #[command(flatten)]
    quiet: QuietFlag,
}

/// A take, and the recording that it becomes.
struct Copy {
    take: PathBuf,
    recording: PathBuf,
}

impl Run for ImportRecordings {
    fn prints_result(&self) -> bool {
        false
    }

    fn run(&self, reporter: &mut Reporter) -> CommandResult {
        let scripts = std::slice::from_ref(&self.script);
        self.stdin.apply(scripts, reporter)?;
        let project = self.file.project(&self.output, reporter)?;
        let settings = &project.settings;
        let options = &settings.options;
        refuse_locales(self.locale.iter().map(String::as_str), options, reporter)?;
        let Some(folder) = settings.audio.folder.as_deref() else {
            let tip = "name the folder of the recordings: folder = \"recordings\" in [audio] of lipz.toml";
            return Err(reporter.usage("the project has no folder of recordings", tip));
        };
        let (inputs, mut reports) = find_all(settings, reporter)?;
        let source_locale = source_locale(settings.voices().original.as_ref(), options, reporter)?;
        let read_options = ReadOptions::new(source_locale.as_str())
            .wanted(self.locale.iter().filter(|locale| **locale != source_locale).cloned())
            .known(locales_of(&inputs, options, &source_locale))
            .extended_locales(options.get_extended_locales());
        let mut incoming = IncomingTexts::read(scripts, &read_options, reporter, &mut reports)?;
        // What concerns texts is for `lipz import texts`.
        incoming.found.retain(|(_, diagnostic)| diagnostic.code != Code::ExchangeLoss);
        let takes = std::mem::take(&mut incoming.takes);
        if takes.is_empty() && incoming.found.is_empty() && !have_errors(&reports) {
            return Err(reporter.usage("no take is chosen", "write the chosen takes into the column `take`"));
        }
        let keys: BTreeSet<&str> = inputs.iter().map(|input| input.key.as_str()).collect();
        let (recordings, unread) = Recordings::discover_with_reports(settings);
        reports.extend(unread);
        let files = TakeFiles::below(&self.takes).map_err(|error| reporter.fail(unreadable(&self.takes, &error)))?;
        let places = TakePlaces { settings, folder, recordings, files };
        let mut copies: Vec<Copy> = Vec::new();
        for (file, take) in &takes {
            match places.copy(take, &keys, self.locale.as_deref()) {
                Ok(copy) => match copies.iter().find(|other| other.recording == copy.recording) {
                    Some(other) if other.take != copy.take => incoming.found.push((*file, twice(take, &other.take))),
                    Some(_) => {}
                    None => copies.push(copy),
                },
                Err(found) => incoming.found.push((*file, *found)),
            }
        }
        reports.extend(incoming.reports());
        self.deliver(&copies, reports, reporter)
    }
}

/// Returns the diagnostic for a second take of a line.
fn twice(take: &ChosenTake, first: &Path) -> Diagnostic {
    let (key, first) = (escape::quoted(&take.key.text), console::path(first));
    let message = format!("two takes of {key} are chosen, this one and `{first}`");
    Diagnostic::at(Code::MissingTake, take.name.span, message).help("delete one of the two")
}

impl ImportRecordings {
    /// Copies all takes, unless there is an error.
    fn deliver(&self, copies: &[Copy], mut reports: Vec<Report>, reporter: &mut Reporter) -> CommandResult {
        let (mut new, mut replaced, mut unchanged) = (Vec::new(), Vec::new(), 0);
        for copy in copies {
            match self.change(copy) {
                Ok(Change::New) => new.push(copy),
                Ok(Change::Replaced) => replaced.push(copy),
                Ok(Change::Unchanged) => unchanged += 1,
                Err(report) => reports.push(*report),
            }
        }
        if have_errors(&reports) {
            return reporter.end(reports, None);
        }
        let files = Files::new();
        for Copy { take, recording } in new.iter().chain(&replaced) {
            let written = match read(take) {
                Ok(bytes) => files.replace(recording, &bytes),
                Err(error) => Err(unreadable(take, &error)),
            };
            reports.extend(written.err());
        }
        reports.extend(files.finish());
        let (new, replaced) = (new.len(), replaced.len());
        let summary = format!("takes copied: {new} new, {replaced} replaced, {unchanged} unchanged\n");
        reporter.end(reports, (!self.quiet.is_set()).then_some(summary))
    }

    /// Compares a take with the existing recording.
    fn change(&self, Copy { take, recording }: &Copy) -> Result<Change, Box<Report>> {
        if !recording.exists() {
            return Ok(Change::New);
        }
        let bytes = |path: &Path| read(path).map_err(|error| Box::new(unreadable(path, &error)));
        if bytes(take)? == bytes(recording)? {
            return Ok(Change::Unchanged);
        }
        if self.overwrite {
            return Ok(Change::Replaced);
        }
        let shown = console::path(recording);
        let message = format!("`{shown}` already exists, and is not `{}`", console::path(take));
        let found = Diagnostic::new(Code::WouldOverwrite, message).note("nothing was copied");
        Err(Box::new(Report::about(shown, found.help("replace recordings with --overwrite"))))
    }
}

/// The effect of a take on its recording.
enum Change {
    New,
    Replaced,
    Unchanged,
}

/// The places of takes and of recordings.
struct TakePlaces<'s> {
    settings: &'s Settings,
    folder: &'s Path,
    recordings: Recordings,
    files: TakeFiles,
}

impl TakePlaces<'_> {
    /// Returns the file of a take, and the path of its recording.
    fn copy(&self, take: &ChosenTake, keys: &BTreeSet<&str>, locale: Option<&str>) -> Result<Copy, Box<Diagnostic>> {
        let original = take.key.text.trim();
        if !keys.contains(original) {
            let message = format!("the project has no clip {}", escape::quoted(original));
            let found = Diagnostic::at(Code::UnknownTextKey, take.key.span, message);
            let mut found = found.help("correct the key if the clip was renamed after the export");
            found.severity = lipz_diagnostics::Severity::Error;
            return Err(Box::new(found));
        }
        let locale = locale.or(take.locale.as_deref());
        let key = locale.and_then(|locale| self.settings.voices().dub_of(original, locale));
        let key = key.as_deref().unwrap_or(original);
        let refused = |message: String, help: String| {
            Box::new(Diagnostic::at(Code::MissingTake, take.name.span, message).help(help))
        };
        let file = self.files.find(take.name.text.trim(), original).map_err(|why| refused(why.message, why.help))?;
        let place = self.folder.join(self.recordings.place(key));
        let is_whole = lipz_compiler::settings::sound_rank(&place).is_some();
        let extension = file.extension().unwrap_or_default().to_string_lossy().into_owned();
        let recording = match is_whole {
            true => place,
            false => PathBuf::from(format!("{}.{extension}", place.to_string_lossy())),
        };
        let is_same = recording.extension().is_some_and(|own| own.eq_ignore_ascii_case(&*extension));
        let other = self.recordings.find(key).filter(|other| other.extension() != recording.extension());
        if !is_same || other.is_some() {
            let expected = console::path(other.unwrap_or(&recording));
            let message = format!("the take `{}` cannot become the recording `{expected}`", console::path(&file));
            let help = "convert the take to this format, or remove the recording".to_owned();
            return Err(refused(message, help));
        }
        Ok(Copy { take: file, recording })
    }
}
