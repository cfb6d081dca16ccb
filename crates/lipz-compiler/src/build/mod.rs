//! Banks from `build.rs`. Only this part of the library prints, and reads the environment.

mod error;

pub use error::BuildError;

use crate::files::path::display;
use crate::files::{Replace, replace_file};
use crate::project::settings::Settings;
use crate::project::{Options, depend};
use crate::run::{Compiled, Compiler, Outputs};
use crate::sources::Input;
use crate::views::ids::{self, Language};
use lipz_bank::Dialogue;
use lipz_bank::files::{DialogueError, DialogueFile};
use lipz_diagnostics::reports::count;
use lipz_diagnostics::{Code, Diagnostic, Report, Severity, escape, render};
use std::env;
use std::ffi::OsStr;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Packs Lipz files while cargo builds a program, from its `build.rs`:
///
/// ```no_run
/// fn main() -> Result<(), lipz_compiler::BuildError> {
///     lipz_compiler::Build::new("voices").run()
/// }
/// ```
///
/// The build writes two files to the folder `OUT_DIR`, which cargo sets for each build script: the bank
/// `dialogue.lipzbank`, and `dialogue.rs` with a constant per clip and per locale (see [`ids`]). The
/// program includes them from there:
///
/// ```text
/// static BANK: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/dialogue.lipzbank"));
///
/// mod dialogue {
///     include!(concat!(env!("OUT_DIR"), "/dialogue.rs"));
/// }
///
/// let clip = bank.clip(dialogue::act1::MARA_GOOD_EVENING); // misspelt, it does not compile
/// ```
///
/// With the feature `cache`, a third file, `dialogue.lipzcache`, stores the checked Lipz files, so that the next run
/// reads only those that have changed.
///
/// Diagnostics appear as warnings and errors of cargo (1.84 or later), one line each. The script runs
/// again when a file of the sources changes, is added or removed.
#[derive(Clone, Debug, Default)]
pub struct Build {
    settings_file: Option<PathBuf>,
    ignores_settings: bool,
    sources: Vec<PathBuf>,
    root: Option<PathBuf>,
    options: Option<Options>,
    name: Option<String>,
    parts: Parts,
}

/// The parts of a bank that are written to separate files.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
enum Parts {
    #[default]
    Nothing,
    /// The texts of each locale.
    Locales,
    /// The dubs of each voice.
    Voices,
}

/// The default name of the outputs.
const DEFAULT_NAME: &str = "dialogue";

impl Build {
    /// Creates a build of the Lipz files in `source`: a folder, a file or a glob pattern, relative to the package.
    ///
    /// Like `lipz pack`, it uses the settings of the project: from the nearest `lipz.toml` next to or above the source,
    /// or else that of the package. This requires the feature `settings`. Without it, or if [`options`](Build::options)
    /// replaces the settings, a warning reports that the file is not used.
    pub fn new(source: impl Into<PathBuf>) -> Build {
        Build { sources: vec![source.into()], ..Build::default() }
    }

    /// Creates a build with the settings of a project, `lipz.toml`, which the methods below override. Its `output`,
    /// `split-locales` and `split-voices` are ignored, because the outputs are those of a build script.
    #[cfg(feature = "settings")]
    pub fn from_settings(file: impl Into<PathBuf>) -> Build {
        Build { settings_file: Some(file.into()), ..Build::default() }
    }

    /// Ignores `lipz.toml`, so that only the script decides. Use it if that file belongs to a different bank.
    #[must_use]
    pub fn without_settings(mut self) -> Build {
        self.ignores_settings = true;
        self
    }

    /// Adds another folder, file or glob pattern.
    #[must_use]
    pub fn source(mut self, source: impl Into<PathBuf>) -> Build {
        self.sources.push(source.into());
        self
    }

    /// Makes keys relative to this folder instead of each source.
    #[must_use]
    pub fn root(mut self, root: impl Into<PathBuf>) -> Build {
        self.root = Some(root.into());
        self
    }

    /// Sets the options of the project, in place of a `lipz.toml`.
    #[must_use]
    pub fn options(mut self, options: Options) -> Build {
        self.options = Some(options);
        self
    }

    /// Names the outputs `NAME.lipzbank` and `NAME.rs`, for programs with several banks.
    #[must_use]
    pub fn name(mut self, name: impl Into<String>) -> Build {
        self.name = Some(name.into());
        self
    }

    /// Packs the texts of each locale into a text bank, `NAME.LOCALE.lipztexts`; `NAME.lipzbank` contains everything
    /// else. Use it for programs that ship or load one language at a time.
    #[must_use]
    pub fn split_locales(mut self, is_split: bool) -> Build {
        self.parts = if is_split { Parts::Locales } else { Parts::Nothing };
        self
    }

    /// Packs the dubs of each voice into a separate bank, `NAME.LOCALE.lipzbank`. It is a layer on top of
    /// `NAME.lipzbank`, which contains the originals and all texts. Use it for programs with a choice of voices. A bank
    /// is split either by locale or by voice: the last call takes precedence.
    #[must_use]
    pub fn split_voices(mut self, is_split: bool) -> Build {
        self.parts = if is_split { Parts::Voices } else { Parts::Nothing };
        self
    }

    /// Packs the bank, writes it and its ids, and reports the diagnostics to cargo.
    ///
    /// # Errors
    /// If there are diagnostics at error level, all of which are printed, or if the script cannot run. The outputs of
    /// the previous run stay unchanged. Return the error from `main` to fail the build.
    pub fn run(self) -> Result<(), BuildError> {
        let folder = env::var_os("OUT_DIR").ok_or(BuildError::NoOutputFolder)?;
        self.run_in(Path::new(&folder), &mut io::stdout().lock())
    }

    /// Runs with the outputs in `folder`. `cargo` is the stream that cargo reads.
    fn run_in(&self, folder: &Path, cargo: &mut dyn Write) -> Result<(), BuildError> {
        let (settings, mut reports) = self.settings();
        if !lipz_diagnostics::reports::have_errors(&reports) {
            reports.extend(self.pack(&settings, folder));
        }
        let mut watched = depend::watched(&settings.sources);
        watched.extend(self.settings_file.clone().or_else(|| self.found_settings()));
        let lines = rerun_lines(&watched) + &render::cargo(&reports);
        cargo.write_all(lines.as_bytes()).and_then(|()| cargo.flush()).map_err(BuildError::Unheard)?;
        match count(&reports, Severity::Error) {
            0 => Ok(()),
            errors => Err(BuildError::Diagnostics { errors }),
        }
    }

    /// Returns the settings of the project, overridden by those of the build, and their problems.
    fn settings(&self) -> (Settings, Vec<Report>) {
        let (mut settings, report) = self.file_settings();
        if !self.sources.is_empty() {
            settings.sources.clone_from(&self.sources);
        }
        settings.root = self.root.clone().or(settings.root);
        settings.options.voices = settings.voices();
        settings.options = self.options.clone().unwrap_or(settings.options);
        (settings, vec![report])
    }

    /// Returns the settings in the project's file, which is named by the script or found.
    fn file_settings(&self) -> (Settings, Report) {
        if let Some(file) = &self.settings_file {
            return read_settings(file);
        }
        match (self.found_settings(), &self.options) {
            (Some(file), None) => read_settings(&file),
            (Some(file), Some(_)) => {
                let help = "call `Build::from_settings` without options, or `Build::without_settings`";
                (Settings::default(), unused(&file, "the build script calls `Build::options`", help))
            }
            (None, _) => Default::default(),
        }
    }

    /// Returns the settings file found for the sources; `None` if no file was found, or if the script does not use one.
    fn found_settings(&self) -> Option<PathBuf> {
        if self.ignores_settings || self.settings_file.is_some() { None } else { Settings::find_of(&self.sources) }
    }

    /// Writes the outputs if there are no errors.
    fn pack(&self, settings: &Settings, folder: &Path) -> Vec<Report> {
        let name = self.name.as_deref().unwrap_or(DEFAULT_NAME);
        if Path::new(name).file_name() != Some(OsStr::new(name)) {
            let message = format!("`{name}` is not a file name");
            return vec![Report::failure("", Code::OutputFailed, message, "name the outputs without a folder")];
        }
        let path = |extension: &str| folder.join(format!("{name}.{extension}"));
        let bank = path("lipzbank");
        let (inputs, mut reports) = settings.discover_with_reports();
        let mut ids = String::new();
        let accept = |bank: &[u8]| {
            ids = rust_ids(bank, settings)?;
            Ok(())
        };
        if settings.audio.in_bank && settings.options.recordings.is_empty() {
            let message = "the settings put recordings into the bank, but the build script does not read any";
            let help =
                "pass the result of `lipz_sync::in_bank` to `Options::recordings`, or set `in-bank = false` in [audio]";
            reports.push(Report::failure("", Code::SettingValue, message, help));
        }
        let compiler = Compiler::new(settings.options.clone());
        let mut compiled = match lipz_diagnostics::reports::have_errors(&reports) {
            true => compiler.check(&inputs),
            false if self.parts != Parts::Nothing => {
                let outputs = Outputs::new(&bank).split_locales(self.parts == Parts::Locales);
                split(&compiler, &inputs, &outputs.split_voices(self.parts == Parts::Voices), accept)
            }
            #[cfg(feature = "cache")]
            false => compiler.pack_cached_if(&inputs, &bank, &path("lipzcache"), accept),
            #[cfg(not(feature = "cache"))]
            false => compiler.pack_if_accepted(&inputs, &bank, accept),
        };
        reports.append(&mut compiled.reports);
        if compiled.bank.is_some() {
            reports.extend(replace_file(&path("rs"), ids.as_bytes()).err());
        }
        lipz_diagnostics::reports::sort(&mut reports);
        reports
    }
}

#[cfg(feature = "settings")]
fn read_settings(file: &Path) -> (Settings, Report) {
    Settings::read_with_report(file)
}

#[cfg(not(feature = "settings"))]
fn read_settings(file: &Path) -> (Settings, Report) {
    let help = "add `features = [\"settings\"]` to lipz-compiler in [build-dependencies], or call \
                `Build::without_settings`";
    (Settings::default(), unused(file, "lipz-compiler is built without the feature `settings`", help))
}

/// Returns the warning that this bank does not use the settings of the project, so that it may differ from that of
/// `lipz pack`.
fn unused(file: &Path, why: &str, help: &str) -> Report {
    let file = display(file);
    let message = format!("the settings file `{file}` is not used: {why}");
    let mut diagnostic = Diagnostic::new(Code::SettingsUnreadable, message).help(help);
    diagnostic.severity = Severity::Warning;
    Report::about(file, diagnostic)
}

/// Packs `inputs` into a bank and separate files, if `accept` finds no errors in the whole bank.
fn split(
    compiler: &Compiler<'_>,
    inputs: &[Input],
    outputs: &Outputs,
    accept: impl FnOnce(&[u8]) -> Result<(), Report>,
) -> Compiled {
    let mut compiled = compiler.compile(inputs);
    let Some(bank) = &compiled.bank else { return compiled };
    if let Err(report) = accept(bank).and_then(|()| outputs.deliver(bank, Replace::IfDifferent)) {
        compiled.reports.push(report);
        compiled.bank = None;
    }
    compiled
}

/// Returns the ids of a bank's clips, or a report about equal ones.
fn rust_ids(bank: &[u8], settings: &Settings) -> Result<String, Report> {
    let damaged = |found: DialogueError| vec![Diagnostic::new(Code::BankDamaged, found.error().kind().message())];
    let mut files = [DialogueFile::ABSENT];
    let dialogue = Dialogue::open_unverified(&mut files, [bank]).map_err(damaged);
    let ids = dialogue.and_then(|dialogue| ids::generate(&dialogue, Language::Rust, None));
    ids.map_err(|diagnostics| {
        let path = settings.sources.first().map(|source| display(source)).unwrap_or_default();
        Report::all_about(path, diagnostics)
    })
}

/// Returns the lines that make cargo run the script again when something at `paths` changes, including everything below
/// a folder. A path that does not fit into one line is written as a path that does not exist, so that the script always
/// runs.
fn rerun_lines(paths: &[PathBuf]) -> String {
    paths.iter().map(|path| format!("cargo::rerun-if-changed={}\n", escape::text(&display(path)))).collect()
}

#[cfg(test)]
mod tests;
