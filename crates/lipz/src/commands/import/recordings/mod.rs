//! `lipz import recordings`: copies the takes that a director chose into the folder of recordings.

mod places;
mod takes;

use crate::commands::Run;
use crate::commands::import::incoming_texts::IncomingTexts;
use crate::console;
use crate::interrupt::Files;
use crate::reporter::{Abort, CommandResult, Reporter};
use crate::shared::input_file::{read, unreadable};
use crate::shared::inputs::find_all;
use crate::shared::run_flags::QuietFlag;
use crate::shared::settings_file::SettingsFile;
use crate::shared::stdin_file::StdinFile;
use crate::shared::stdio;
use crate::shared::translations::locales_of;
use crate::shared::values::{parse_locale, refuse_locales};
use crate::shared::voices::{original_locale, recordings, refuse_unknown_voice};
use clap::Args;
use lipz_compiler::key::folded;
use lipz_compiler::settings::Settings;
use lipz_diagnostics::{Code, Diagnostic, Report, Severity, reports::have_errors};
use lipz_sync::FileFacts;
use lipz_texts::{ChosenTake, ReadOptions};
use places::{Chosen, Copy, TakePlaces};
use std::collections::HashMap;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use takes::TakeFiles;

/// Copy the chosen takes of a recording script into the folder of recordings.
///
/// The column `take` of the script, which `lipz export recording-script` writes, has the number of a take or the name of its
/// file. lipz checks all takes before it copies the first one.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz import recordings script.xlsx takes
  lipz import recordings pick-ups.csv monday --overwrite")]
pub(crate) struct ImportRecordings {
    /// Recording script: .xlsx, .csv, .tsv, .ods; `-` is standard input, with --stdin-filename
    #[arg(value_name = "SCRIPT")]
    script: PathBuf,

    /// Folder with the takes of the session
    #[arg(value_name = "TAKES")]
    takes: PathBuf,

    /// Lipz files of the project: folders, files or patterns [default: those of lipz.toml]
    #[arg(short, long, value_name = "SOURCES")]
    output: Vec<PathBuf>,

    /// Spoken locale, if the table has translations into several [default: that of the translations]
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
        if !self.takes.is_dir() {
            let is_what = if self.takes.exists() { "is a file, not a folder of takes" } else { "does not exist" };
            let message = format!("`{}` {is_what}", console::path(&self.takes));
            return Err(reporter.usage(message, "name the folder that contains the takes"));
        }
        let (inputs, mut reports) = find_all(settings, reporter)?;
        let original = original_locale(settings, reporter)?;
        let read_options = ReadOptions::new(original.as_str())
            .known(locales_of(&inputs, options, &original))
            .extended_locales(options.get_extended_locales())
            .takes(true);
        self.refuse_other_formats(reporter)?;
        let mut incoming = IncomingTexts::read(scripts, &read_options, reporter, &mut reports)?;
        for (_, found) in &mut incoming.found {
            // A cell or a sheet that is not read may have a take.
            found.severity = Severity::Error;
        }
        let takes = std::mem::take(&mut incoming.takes);
        if takes.is_empty() && incoming.found.is_empty() && !have_errors(&reports) {
            return Err(reporter.usage("no take is chosen", "write the chosen takes into the column `take`"));
        }
        let voice = self.voice(&takes, &original, settings, reporter)?;
        let (recordings, unread) = recordings(settings);
        reports.extend(unread);
        let keys: HashMap<String, &str> = inputs.iter().map(|input| (folded(&input.key), input.key.as_str())).collect();
        let files = TakeFiles::below(&self.takes, keys.values().copied());
        let files = files.map_err(|error| reporter.refuse(error.reports().to_vec()))?;
        let places = TakePlaces { folder, voices: settings.voices(), voice, recordings, files, keys };
        let mut copies: Vec<Copy> = Vec::new();
        let mut chosen = Chosen::default();
        for (file, take) in &takes {
            let copy = places.copy(take).and_then(|copy| chosen.add(copy, take));
            match copy {
                Ok(copy) => copies.extend(copy),
                Err(found) => incoming.found.push((*file, *found)),
            }
        }
        reports.extend(incoming.reports());
        self.deliver(&copies, reports, reporter)
    }
}

impl ImportRecordings {
    /// Refuses files that cannot have a column of takes.
    fn refuse_other_formats(&self, reporter: &mut Reporter) -> Result<(), Abort> {
        let named = if stdio::is_meant(&self.script) { stdio::name() } else { Some(self.script.clone()) };
        let extension = named.as_deref().and_then(Path::extension).and_then(OsStr::to_str).unwrap_or_default();
        if matches!(
            lipz_texts::Format::of_extension(extension),
            Some(lipz_texts::Format::Csv | lipz_texts::Format::Xlsx)
        ) {
            return Ok(());
        }
        if named.is_none() {
            let tip = "name it with `--stdin-filename script.csv`";
            return Err(reporter.usage("the format of the script on standard input is not known", tip));
        }
        let message = format!("`{}` is not a table with chosen takes", console::path(&self.script));
        Err(reporter.usage(message, "use a .xlsx, .ods, .csv or .tsv file of `lipz export recording-script`"))
    }

    /// Returns the spoken locale of the script; `None` for that of the originals.
    fn voice(
        &self,
        takes: &[(usize, ChosenTake)],
        original: &str,
        settings: &Settings,
        reporter: &mut Reporter,
    ) -> Result<Option<String>, Abort> {
        let of_table = takes.first().map(|(_, take)| &*take.locales).unwrap_or_default();
        let voice = match (&self.locale, of_table) {
            (Some(wanted), several) if !several.is_empty() && !several.iter().any(|own| **own == **wanted) => {
                let own: Vec<&str> = several.iter().map(|own| &**own).collect();
                let message = format!("the script is for {}, not for {wanted}", own.join(" and "));
                return Err(reporter.usage(message, "leave out `--locale`, or name the script for this voice"));
            }
            (Some(wanted), _) => Some(wanted.clone()),
            (None, []) => None,
            (None, [only]) => Some(only.to_string()),
            (None, several) => {
                let message = format!("the table has translations into {} locales", several.len());
                return Err(reporter.usage(message, "name the spoken one with `--locale`, as in de-de"));
            }
        };
        let voice = voice.filter(|voice| voice != original);
        refuse_unknown_voice(voice.as_deref(), settings, reporter)?;
        Ok(voice)
    }

    /// Copies the takes, unless there is an error.
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
        let mut failures = Vec::new();
        for Copy { take, recording } in new.iter().chain(&replaced) {
            let written = match read(take) {
                Ok(bytes) => files.replace(recording, &bytes),
                Err(error) => Err(unreadable(take, &error)),
            };
            failures.extend(written.err());
        }
        failures.extend(files.finish());
        let all = new.len() + replaced.len();
        let summary = match failures.len() {
            0 => format!("takes copied: {} new, {} replaced, {unchanged} unchanged\n", new.len(), replaced.len()),
            failed => format!("takes copied: {} of {all}\n", all.saturating_sub(failed)),
        };
        reports.extend(failures);
        reporter.end(reports, (!self.quiet.is_set()).then_some(summary))
    }

    /// Compares a take, which must be a sound, with the existing recording.
    fn change(&self, Copy { take, recording }: &Copy) -> Result<Change, Box<Report>> {
        FileFacts::length_us(take).map_err(Box::new)?;
        if recording.symlink_metadata().is_err() {
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
