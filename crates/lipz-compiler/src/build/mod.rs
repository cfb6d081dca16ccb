//! Banks from `build.rs`: the one part of this library that prints, and that reads the environment.

use crate::ids::{self, Language};
use crate::settings::Settings;
use crate::{Compiled, Compiler, Input, Options, Outputs, Replace, depend, discover, replace_file};
use lipz_bank::Bank;
use lipz_diagnostics::reports::count;
use lipz_diagnostics::{Code, Diagnostic, Report, Severity, escape, render};
use std::ffi::OsStr;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::{env, fmt};

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
    is_split: bool,
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
    /// `output` and `split-locales` are left alone: the outputs are those of a build script.
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
        self.is_split = is_split;
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
        let (inputs, mut reports) = settings.discover();
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
            false if self.is_split => split(&compiler, &inputs, &bank, accept),
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
    Settings::read(file)
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

/// Packs `inputs` into a bank at `path` and text banks beside it, if `accept` finds nothing in the whole.
fn split(
    compiler: &Compiler<'_>,
    inputs: &[Input],
    path: &Path,
    accept: impl FnOnce(&[u8]) -> Result<(), Report>,
) -> Compiled {
    let mut compiled = compiler.compile(inputs);
    let Some(bank) = &compiled.bank else { return compiled };
    let outputs = Outputs::new(path).split_locales(true);
    if let Err(report) = accept(bank).and_then(|()| outputs.deliver(bank, Replace::IfDifferent)) {
        compiled.reports.push(report);
        compiled.bank = None;
    }
    compiled
}

/// The ids of a bank's clips, or which ones are the same.
fn rust_ids(bank: &[u8], settings: &Settings) -> Result<String, Report> {
    let damaged = |error: lipz_bank::Error| vec![Diagnostic::new(Code::BankDamaged, error.kind().message())];
    let ids = Bank::open(bank).map_err(damaged).and_then(|bank| ids::generate(&bank, Language::Rust, None));
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

/// Why a build script failed, for `main` to return.
pub enum BuildError {
    /// Diagnostics at error level. Cargo shows each.
    Diagnostics {
        /// How many.
        errors: usize,
    },
    /// `OUT_DIR` is not set: the program is not a build script that cargo runs.
    NoOutputFolder,
    /// Standard output, where cargo reads, cannot be written.
    Unheard(io::Error),
}

impl fmt::Display for BuildError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            BuildError::Diagnostics { errors: 1 } => f.write_str("1 error in Lipz files; no bank was written"),
            BuildError::Diagnostics { errors } => write!(f, "{errors} errors in Lipz files; no bank was written"),
            BuildError::NoOutputFolder => {
                f.write_str("OUT_DIR is not set: `lipz_compiler::Build` runs in build scripts of cargo only")
            }
            BuildError::Unheard(error) => write!(f, "standard output cannot be written: {error}"),
        }
    }
}

/// The same words: this is what a `main` that returns the error prints.
impl fmt::Debug for BuildError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl std::error::Error for BuildError {}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    const CLIP: &str = r#"{ "fps": 24, "visemes": "MAEO-", "viseme_type": "blair", "text_en-us": "Mayor!" }"#;

    const OUTPUTS: [&str; 3] = ["dialogue.lipzbank", "dialogue.lipzcache", "dialogue.rs"];

    /// Runs a build of `files` in `voices`; what it told cargo, and the names of its outputs.
    fn run(scene: &Path, build: impl FnOnce(Build) -> Build, files: &[(&str, &str)]) -> (String, Vec<String>) {
        for (name, text) in files {
            let path = scene.join("voices").join(name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, text).unwrap();
        }
        let (mut cargo, outputs) = (Vec::new(), scene.join("out"));
        fs::create_dir_all(&outputs).unwrap();
        let result = build(Build::new(scene.join("voices"))).run_in(&outputs, &mut cargo);
        let lines = String::from_utf8(cargo).unwrap().replace(&*discover::display(scene), "SCENE");
        assert_eq!(result.is_err(), lines.contains("cargo::error="), "{result:?}: {lines}");
        let mut names: Vec<String> =
            fs::read_dir(outputs).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        (lines, names)
    }

    #[test]
    fn a_clean_build_writes_bank_and_ids() {
        let scene = tempfile::tempdir().unwrap();
        let (lines, names) = run(scene.path(), |build| build, &[("act1/mayor.lipz", CLIP)]);
        assert_eq!(lines, "cargo::rerun-if-changed=SCENE/voices\n");
        assert_eq!(names, OUTPUTS);
        let bytes = fs::read(scene.path().join("out/dialogue.lipzbank")).unwrap();
        assert!(Bank::open(&bytes).unwrap().verify().unwrap().clip_by_key("act1/mayor").is_some());
        let ids = fs::read_to_string(scene.path().join("out/dialogue.rs")).unwrap();
        assert!(ids.contains("pub const MAYOR: ::lipz_bank::ClipId"), "{ids}");
    }

    #[test]
    fn the_next_run_gives_the_same_and_remembers() {
        let scene = tempfile::tempdir().unwrap();
        let outputs = || OUTPUTS.map(|name| fs::read(scene.path().join("out").join(name)).unwrap());
        run(scene.path(), |build| build, &[("aye.lipz", CLIP)]);
        let [bank, _, ids] = outputs();
        fs::remove_file(scene.path().join("out/dialogue.rs")).unwrap();
        run(scene.path(), |build| build, &[]);
        assert_eq!([outputs()[0].as_slice(), &outputs()[2]], [&bank, &ids], "also if a file was lost");
        let (path, cache) = (scene.path().join("out/dialogue.lipzbank"), scene.path().join("out/dialogue.lipzcache"));
        let (inputs, _) = discover(&[scene.path().join("voices")], None);
        let next = Compiler::default().pack_cached(&inputs, &path, &cache);
        assert_eq!((next.recalled, next.is_unchanged), (1, true));
        run(scene.path(), |build| build, &[("no.lipz", CLIP)]);
        assert!(String::from_utf8(outputs()[2].clone()).unwrap().contains("pub const NO:"), "a new clip has an id");
    }

    #[test]
    fn errors_are_all_told_and_leave_the_outputs() {
        let scene = tempfile::tempdir().unwrap();
        run(scene.path(), |build| build, &[("aye.lipz", CLIP)]);
        let before = fs::read(scene.path().join("out/dialogue.lipzbank")).unwrap();
        let foreign = "{\n  \"viseme_type\": \"blair\",\n  \"visemes\": \"MAZ-\" }";
        let (lines, _) = run(scene.path(), |build| build, &[("b.lipz", foreign), ("c.lipz", ""), ("d.lipz", "{}")]);
        let told: Vec<&str> = lines.lines().filter(|line| !line.contains("rerun")).collect();
        assert_eq!(told.len(), 3, "{lines}");
        assert!(
            told[0].starts_with("cargo::error=SCENE/voices/b.lipz:3:17: `Z` is not a blair code [LZ0401]; "),
            "{lines}"
        );
        assert!(told[1].starts_with("cargo::error=SCENE/voices/c.lipz: the file is empty [LZ0002]"), "{lines}");
        assert!(told[2].starts_with("cargo::warning=SCENE/voices/d.lipz"), "{lines}");
        assert_eq!(fs::read(scene.path().join("out/dialogue.lipzbank")).unwrap(), before);
    }

    #[test]
    fn clashes_and_bad_names_write_nothing() {
        let scene = tempfile::tempdir().unwrap();
        let (lines, names) = run(scene.path(), |build| build, &[("a-b.lipz", CLIP), ("a_b.lipz", CLIP)]);
        assert!(lines.contains("cargo::error=SCENE/voices: the keys `a-b` and `a_b` have the same"), "{lines}");
        assert_eq!(names, [""; 0]);
        fs::remove_file(scene.path().join("voices/a-b.lipz")).unwrap();
        for name in ["../x", "", "..", "x/"] {
            let (lines, names) = run(scene.path(), |build| build.name(name), &[]);
            assert!(lines.contains("[LZ0904]"), "{lines}");
            assert_eq!(names, [""; 0], "{name}");
        }
    }

    #[test]
    fn split_locales_are_files_of_their_own() {
        let scene = tempfile::tempdir().unwrap();
        let clip = r#"{ "text_en-us": "Mayor!", "text_de-de": "Meister!" }"#;
        let (_, names) = run(scene.path(), |build| build.split_locales(true), &[("mayor.lipz", clip)]);
        let expected = ["dialogue.de-de.lipztexts", "dialogue.en-us.lipztexts", "dialogue.lipzbank", "dialogue.rs"];
        assert_eq!(names, expected);
        let read = |name: &str| fs::read(scene.path().join("out").join(name)).unwrap();
        let (base, german) = (read("dialogue.lipzbank"), read("dialogue.de-de.lipztexts"));
        let bank = Bank::open(&base).unwrap().verify().unwrap();
        assert!(bank.locale("de-de").is_none());
        assert!(bank.open_texts(&german).unwrap().verify(&bank).is_ok());
        let (lines, names) = run(scene.path(), |build| build.split_locales(true), &[("no.lipz", "")]);
        assert!(lines.contains("cargo::error="), "{lines}");
        assert_eq!(names, expected, "what was there stays");
    }

    #[test]
    fn a_path_cannot_leave_its_line() {
        assert_eq!(rerun_lines(&["a\nb".into()]), "cargo::rerun-if-changed=a\\nb\n");
    }

    #[test]
    fn settings_hold_and_are_watched() {
        let scene = tempfile::tempdir().unwrap();
        let file = scene.path().join("lipz.toml");
        let by_settings = |text: &str| {
            fs::write(&file, text).unwrap();
            run(scene.path(), |_| Build::from_settings(&file), &[("act1/mayor.lipz", r#"{ "text": "Mayor!" }"#)])
        };
        let (lines, names) = by_settings("sources = [\"voices\"]\ndefault-locale = \"en-us\"\n");
        assert!(lines.starts_with("cargo::rerun-if-changed=SCENE/voices\ncargo::rerun-if-changed=SCENE/lipz.toml\n"));
        assert!(lines.contains("[LZ0502]") && !lines.contains("error"), "{lines}");
        assert_eq!(names, OUTPUTS);
        let (lines, _) = by_settings("sources = [\"voices\"]\n[audio]\nin-bank = true\n");
        assert!(lines.contains("cargo::error=the settings put recordings into the bank"), "{lines}");
        let (lines, _) = by_settings("default-local = \"en-us\"\n");
        assert!(lines.contains("cargo::error=SCENE/lipz.toml:1:1: "), "{lines}");
    }

    #[test]
    fn the_settings_beside_the_sources_hold() {
        let scene = tempfile::tempdir().unwrap();
        let files = [("mayor.lipz", r#"{ "text": "Mayor!" }"#), ("lipz.toml", "default-locale = \"en-us\"\n")];
        let (lines, names) = run(scene.path(), |build| build, &files);
        let watched = "cargo::rerun-if-changed=SCENE/voices\ncargo::rerun-if-changed=SCENE/voices/lipz.toml\n";
        assert!(lines.starts_with(watched), "{lines}");
        assert!(lines.contains("[LZ0502]") && !lines.contains("error"), "{lines}");
        assert_eq!(names, OUTPUTS);
        let command = Settings::read(&scene.path().join("voices/lipz.toml")).0;
        let (inputs, _) = discover(&[scene.path().join("voices")], None);
        let expected = Compiler::new(command.options).compile(&inputs).bank;
        assert_eq!(Some(fs::read(scene.path().join("out/dialogue.lipzbank")).unwrap()), expected);

        let options = Options::new().default_locale("de-de");
        let (lines, _) = run(scene.path(), |build| build.options(options.clone()), &[]);
        assert!(
            lines.contains("warning=SCENE/voices/lipz.toml: the settings file `SCENE/voices/lipz.toml` is not used"),
            "{lines}"
        );
        let (lines, _) = run(scene.path(), |build| build.options(options).without_settings(), &[]);
        assert!(!lines.contains("lipz.toml"), "{lines}");
        let (lines, _) = run(scene.path(), Build::without_settings, &[]);
        assert!(lines.contains("cargo::error=") && lines.contains("[LZ0502]"), "{lines}");
    }

    #[test]
    fn sources_that_do_not_exist_are_watched() {
        let scene = tempfile::tempdir().unwrap();
        let (lines, names) = run(scene.path(), |build| build.source("no/where"), &[("aye.lipz", CLIP)]);
        assert!(lines.contains("cargo::rerun-if-changed=no/where\n"), "{lines}");
        assert!(lines.contains("cargo::error=no/where: `no/where` does not exist [LZ0001]; help: check"), "{lines}");
        assert_eq!(names, [""; 0]);
    }
}
