//! `lipz new`: creates a clip with a text, ready for visemes.

use crate::CommandResult;
use crate::Outcome;
use crate::commands::Run;
use crate::console;
use crate::reporter::Reporter;
use crate::shared::formats::path;
use crate::shared::output_file;
use crate::shared::output_file::{OVERWRITE, in_the_way};
use crate::shared::run_flags::QuietFlag;
use crate::shared::settings_file::{Project, SettingsFile};
use crate::shared::sources::PROJECT;
use crate::shared::values::parse_locale;
use clap::Args;
use lipz_compiler::settings::Settings;
use lipz_compiler::{Compiler, Content, Input, key};
use lipz_diagnostics::{Code, Report, escape, reports};
use lipz_file::format::{Style, format};
use std::path::{Path, PathBuf};

/// Write a new clip into the project's folder of Lipz files.
///
/// The clip has no visemes yet. `lipz sync` makes them from its recording, and `lipz import visemes` from files of other tools.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz new act1/mara-hello \"Good evening, Otto.\"
  lipz new act1/mara-later
  lipz new act1/mara-hello \"Guten Abend, Otto.\" --locale de-de
  lipz new act2/otto-aye \"{tired} Aye. |Aye!\"")]
pub(crate) struct NewClip {
    /// Key of the clip: its path in the folder of Lipz files, without `.lipz`
    #[arg(value_name = "KEY")]
    key: String,

    /// Text of the clip; `|` separates segments [default: none]
    #[arg(value_name = "TEXT")]
    text: Option<String>,

    /// Locale of the text [default: `default-locale` of lipz.toml]
    #[arg(long, value_name = "LOCALE", value_parser = parse_locale)]
    locale: Option<String>,

    #[command(flatten)]
    file: SettingsFile,

    /// Folder of Lipz files [default: the first of lipz.toml]
    #[arg(short, long, value_name = "FOLDER", help_heading = PROJECT)]
    output: Option<PathBuf>,

    #[command(flatten)]
    quiet: QuietFlag,
}

impl Run for NewClip {
    fn prints_result(&self) -> bool {
        false
    }

    fn run(&self, reporter: &mut Reporter) -> CommandResult {
        let named: Vec<PathBuf> = self.output.iter().cloned().collect();
        let Project { settings, .. } = self.file.project(&named, reporter)?;
        let Some(locale) = self.locale.as_deref().or(settings.options.get_default_locale()) else {
            let tip = "name it with `--locale`, or set `default-locale` in lipz.toml";
            return Err(reporter.usage("the locale of the text is not set", tip));
        };
        let folder = self.output.as_deref().or(settings.root.as_deref()).or_else(|| first_folder(&settings));
        let Some(folder) = folder else {
            let tip = "name one with `--output`";
            return Err(reporter.usage("the project does not name a folder of Lipz files", tip));
        };
        // Path completion in a shell adds the extension.
        let key = self.key.strip_suffix(".lipz").unwrap_or(&self.key);
        let file = path(folder, key, key::EXTENSION);
        if let Some(report) = refusal(key, folder, &settings, &file) {
            return Err(reporter.refuse(vec![report]));
        }
        let text = layout(locale, self.text.as_deref().unwrap_or_default());
        let content = Content::Bytes { name: console::path(&file), bytes: text.clone().into_bytes() };
        let input = Input { key: key.to_owned(), content };
        let found = Compiler::new(settings.options.clone()).check(&[input]).reports;
        if reports::have_errors(&found) {
            return Err(reporter.refuse(found));
        }
        output_file::write(&file, text.as_bytes(), reporter)?;
        // A clip requested without a text needs no warning about its absence.
        if self.text.is_some() {
            reporter.add(found);
        }
        if !self.quiet.is_set() {
            reporter.summary(&format!("{} written\n", console::path(&file)))?;
        }
        Ok(Outcome::Clean)
    }
}

/// Returns the reason why this file cannot hold a clip with this key.
fn refusal(key: &str, folder: &Path, settings: &Settings, file: &Path) -> Option<Report> {
    let about = |code, message, help: &str| Some(Report::failure(console::path(file), code, message, help));
    let named = escape::quoted(key);
    if let Some(why) = key::refusal(key) {
        let help = "use a path below the folder of Lipz files, such as act1/mara-hello";
        return about(Code::RefusedKey, format!("the key {named} cannot be used: {why}"), help);
    }
    let inside = Path::new(key).strip_prefix(folder).ok().filter(|_| !folder.join(folder).exists());
    if let Some(inside) = inside.filter(|inside| !inside.as_os_str().is_empty()) {
        let help = format!("use the key {}", escape::quoted(&inside.to_string_lossy()));
        return about(Code::RefusedKey, format!("{named} is a path, not a key"), &help);
    }
    if let Some(report) = in_the_way(file, OVERWRITE) {
        return Some(report);
    }
    let (inputs, _) = settings.discover_with_reports();
    let same = inputs.iter().find(|input| key::folded(&input.key) == key::folded(key))?;
    let message = format!("{named} and {} would be the same key", escape::quoted(&same.key));
    about(Code::KeyClash, message, "choose a different key")
}

/// Returns the first folder that the project names, which may not exist yet.
fn first_folder(settings: &Settings) -> Option<&Path> {
    let is_folder = |path: &&Path| {
        let is_pattern = path.to_string_lossy().contains(['*', '?', '[']);
        path.is_dir() || !path.exists() && !is_pattern && path.extension().is_none()
    };
    settings.sources.iter().map(PathBuf::as_path).find(is_folder)
}

/// Returns the clip in canonical layout.
fn layout(locale: &str, text: &str) -> String {
    let file = format!("{{ \"text_{locale}\": {} }}", lipz_file::literal(text));
    let document = lipz_file::parse(file.as_bytes()).document;
    document
        .map_or(file.clone(), |document| format(&document, Style { default_locale: Some(locale), ..Style::default() }))
}
