//! Banks from `build.rs`: the one part of this library that prints, and that reads the environment.

mod error;

pub use error::BuildError;

use crate::ids::{self, Language};
use crate::settings::Settings;
use crate::{Compiled, Compiler, Input, Options, Outputs, Replace, depend, discover, replace_file};
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
/// Two files appear in the folder `OUT_DIR` that cargo gives to each build script: the bank
/// `dialogue.lipzbank`, and `dialogue.rs` with a constant per clip and per locale (see [`ids`]). The
/// program takes them from there:
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
/// With the feature `cache`, a third file, `dialogue.lipzcache`, remembers the Lipz files, so that the next run
/// reads only those that changed.
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

/// What goes into files of its own.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
enum Parts {
    #[default]
    Nothing,
    /// The texts of each locale.
    Locales,
    /// The dubs of each voice.
    Voices,
}

/// What the outputs are called unless the build names them.
const DEFAULT_NAME: &str = "dialogue";

impl Build {
    /// A build of the Lipz files in `source`: a folder, a file or a glob pattern, relative to the
    /// package.
    ///
    /// It goes by the settings of the project, as `lipz pack` does with the same source: by the `lipz.toml` beside or
    /// above the source, else that of the package. That takes the feature `settings`; without it, or if
    /// [`options`](Build::options) decides instead, a warning says that the file is not used.
    pub fn new(source: impl Into<PathBuf>) -> Build {
        Build { sources: vec![source.into()], ..Build::default() }
    }

    /// A build by the settings of a project, `lipz.toml`. What the methods below set goes before them. Its
    /// `output`, `split-locales` and `split-voices` are left alone: the outputs are those of a build script.
    #[cfg(feature = "settings")]
    pub fn from_settings(file: impl Into<PathBuf>) -> Build {
        Build { settings_file: Some(file.into()), ..Build::default() }
    }

    /// Uses no `lipz.toml`: the script alone decides. For projects that have one, which is not for this bank.
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

    /// Makes keys paths below this folder, not below each source.
    #[must_use]
    pub fn root(mut self, root: impl Into<PathBuf>) -> Build {
        self.root = Some(root.into());
        self
    }

    /// Sets what the project decides about its files, in place of a `lipz.toml`.
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

    /// Packs the texts of each locale into a text bank, `NAME.LOCALE.lipztexts`; `NAME.lipzbank` has everything
    /// else. For programs that ship or load one language at a time.
    #[must_use]
    pub fn split_locales(mut self, is_split: bool) -> Build {
        self.parts = if is_split { Parts::Locales } else { Parts::Nothing };
        self
    }

    /// Packs the dubs of each voice into a bank of its own, `NAME.LOCALE.lipzbank`, a layer over `NAME.lipzbank`, which has the
    /// originals and all texts. For programs whose players choose a voice. A bank is split by locale or by voice: the method
    /// that is called last counts.
    #[must_use]
    pub fn split_voices(mut self, is_split: bool) -> Build {
        self.parts = if is_split { Parts::Voices } else { Parts::Nothing };
        self
    }

    /// Packs the bank, writes it and its ids, and tells cargo what was found.
    ///
    /// # Errors
    /// Diagnostics at error level, all of which were printed; and whatever keeps the script from
    /// running. The outputs of the run before are unchanged then. Return the error from `main`: that
    /// fails the build.
    pub fn run(self) -> Result<(), BuildError> {
        let folder = env::var_os("OUT_DIR").ok_or(BuildError::NoOutputFolder)?;
        self.run_in(Path::new(&folder), &mut io::stdout().lock())
    }

    /// Does it with the outputs in `folder`; `cargo` is where cargo reads.
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

    /// The settings of the project, with what the build sets over them, and what is wrong with them.
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

    /// The settings in the file of the project: in the one that the script names, or in the one that is found.
    fn file_settings(&self) -> (Settings, Report) {
        if let Some(file) = &self.settings_file {
            return read_settings(file);
        }
        match (self.found_settings(), &self.options) {
            (Some(file), None) => read_settings(&file),
            (Some(file), Some(_)) => {
                let help = "call `Build::from_settings` without options, or `Build::without_settings`";
                (Settings::default(), unused(&file, "the build script decides with `Build::options`", help))
            }
            (None, _) => Default::default(),
        }
    }

    /// The settings file of the sources, which nobody has named; `None` if there is none, or the script uses none.
    fn found_settings(&self) -> Option<PathBuf> {
        if self.ignores_settings || self.settings_file.is_some() { None } else { Settings::find_of(&self.sources) }
    }

    /// Writes the outputs if nothing that was found is an error.
    fn pack(&self, settings: &Settings, folder: &Path) -> Vec<Report> {
        let name = self.name.as_deref().unwrap_or(DEFAULT_NAME);
        if Path::new(name).file_name() != Some(OsStr::new(name)) {
            let message = format!("`{name}` is not the name of a file");
            return vec![Report::failure("", Code::OutputFailed, message, "name the outputs without folders")];
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
            let message = "the settings put recordings into the bank, but the build script reads none";
            let help =
                "hand what `lipz_sync::in_bank` returns to `Options::recordings`, or set `in-bank = false` in [audio]";
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
            false => compiler.pack_if(&inputs, &bank, accept),
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
    (Settings::default(), unused(file, "lipz-compiler is built without its feature `settings`", help))
}

/// The warning that the settings of the project do not count for this bank, and so it may be another than that of
/// `lipz pack`.
fn unused(file: &Path, why: &str, help: &str) -> Report {
    let file = discover::display(file);
    let message = format!("the settings file `{file}` is not used: {why}");
    let mut diagnostic = Diagnostic::new(Code::SettingsUnreadable, message).help(help);
    diagnostic.severity = Severity::Warning;
    Report::about(file, diagnostic)
}

/// Packs `inputs` into a bank and the files beside it, if `accept` finds nothing in the whole.
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

/// The ids of a bank's clips, or which ones are the same.
fn rust_ids(bank: &[u8], settings: &Settings) -> Result<String, Report> {
    let damaged = |found: DialogueError| vec![Diagnostic::new(Code::BankDamaged, found.error().kind().message())];
    let mut files = [DialogueFile::ABSENT];
    let dialogue = Dialogue::open_unverified(&mut files, [bank]).map_err(damaged);
    let ids = dialogue.and_then(|dialogue| ids::generate(&dialogue, Language::Rust, None));
    ids.map_err(|diagnostics| {
        let path = settings.sources.first().map(|source| discover::display(source)).unwrap_or_default();
        Report::all_about(path, diagnostics)
    })
}

/// The lines that run the script again when something at `paths` changes; cargo looks at all that
/// is below a folder. A path that one line cannot spell is spelled so that it does not exist: then
/// the script always runs.
fn rerun_lines(paths: &[PathBuf]) -> String {
    paths.iter().map(|path| format!("cargo::rerun-if-changed={}\n", escape::text(&discover::display(path)))).collect()
}

#[cfg(test)]
mod tests;
