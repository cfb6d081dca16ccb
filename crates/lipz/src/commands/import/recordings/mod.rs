//! `lipz import recordings`: copies the takes that a director chose into the folder of recordings.

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
use lipz_compiler::Voices;
use lipz_compiler::key::folded;
use lipz_compiler::settings::{Settings, sound_rank};
use lipz_diagnostics::{Code, Diagnostic, Report, Severity, escape, reports::have_errors};
use lipz_sync::{FileFacts, Recordings};
use lipz_texts::{ChosenTake, ReadOptions};
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
    /// Recording script: .xlsx, .csv, .tsv, .ods; `-` is standard input
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

/// The takes and recordings so far, each with the key of its line.
#[derive(Default)]
struct Chosen {
    by_recording: HashMap<PathBuf, PathBuf>,
    by_take: HashMap<PathBuf, String>,
}

impl Chosen {
    /// Returns the copy, or `None` if it repeats one. Refuses a second take of a line, and a second line of a take.
    fn add(&mut self, copy: Copy, take: &ChosenTake) -> Result<Option<Copy>, Box<Diagnostic>> {
        let refused = |message: String| {
            let found = Diagnostic::at(Code::UnusableTake, take.name.span, message);
            Err(Box::new(found.help("delete one of the two")))
        };
        let key = escape::quoted(&take.key.text);
        match self.by_recording.get(&copy.recording) {
            Some(first) if *first == copy.take => return Ok(None),
            Some(first) => {
                return refused(format!("two takes of {key} are chosen, this one and `{}`", console::path(first)));
            }
            None => {}
        }
        if let Some(other) = self.by_take.insert(copy.take.clone(), take.key.text.clone()) {
            let (file, other) = (console::path(&copy.take), escape::quoted(&other));
            return refused(format!("the take `{file}` is chosen for {key} and for {other}"));
        }
        self.by_recording.insert(copy.recording.clone(), copy.take.clone());
        Ok(Some(copy))
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
            (Some(wanted), [only]) if **only != **wanted => {
                let message = format!("the script is for {only}, not for {wanted}");
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

/// The places of takes and of recordings.
struct TakePlaces<'s> {
    folder: &'s Path,
    voices: Voices,
    /// The locale of the voice; `None` for that of the originals.
    voice: Option<String>,
    recordings: Recordings,
    files: TakeFiles,
    /// The keys of all clips, by their folded form.
    keys: HashMap<String, &'s str>,
}

impl TakePlaces<'_> {
    /// Returns the file of a take, and the path of its recording.
    fn copy(&self, take: &ChosenTake) -> Result<Copy, Box<Diagnostic>> {
        let written = take.key.text.trim();
        let Some(original) = self.keys.get(&folded(written)).copied() else {
            let message = format!("the project has no clip {}", escape::quoted(written));
            let found = Diagnostic::at(Code::UnknownTextKey, take.key.span, message);
            let mut found = found.help("correct the key if the clip was renamed after the export");
            found.severity = Severity::Error;
            return Err(Box::new(found));
        };
        let refused = |message: String, help: String| {
            Box::new(Diagnostic::at(Code::UnusableTake, take.name.span, message).help(help))
        };
        let key = match &self.voice {
            None => Some(original.to_owned()),
            Some(voice) => self.voices.dub_of(original, voice),
        };
        let key = key.ok_or_else(|| {
            let message = format!("{} has no dub in this voice", escape::quoted(original));
            refused(message, "correct the patterns in [voices] of lipz.toml".to_owned())
        })?;
        let file = self.files.find(take.name.text.trim(), original).map_err(|why| refused(why.message, why.help))?;
        let recording = self.recording(&key, &file);
        if !has_same_extension(&recording, &file) {
            let (take, recording) = (console::path(&file), console::path(&recording));
            let message = format!("the take `{take}` cannot become the recording `{recording}`");
            return Err(refused(message, "convert the take to the format of the recording".to_owned()));
        }
        Ok(Copy { take: file, recording })
    }

    /// Returns the path of a clip's recording: the existing one, or that of the project's patterns.
    fn recording(&self, key: &str, take: &Path) -> PathBuf {
        if let Some(existing) = self.recordings.find(key) {
            return existing.to_owned();
        }
        let place = self.folder.join(self.recordings.place(key));
        if sound_rank(&place).is_some() {
            return place;
        }
        let mut path = place.into_os_string();
        path.push(".");
        path.push(take.extension().unwrap_or_default());
        path.into()
    }
}

fn has_same_extension(one: &Path, other: &Path) -> bool {
    let extensions = one.extension().zip(other.extension());
    extensions.is_some_and(|(one, other)| one.eq_ignore_ascii_case(other))
}
