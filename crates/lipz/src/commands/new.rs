//! `lipz new`: a clip with a text, for which a mouth can be made.

use crate::Ended;
use crate::Outcome;
use crate::commands::Run;
use crate::console;
use crate::reporter::Reporter;
use crate::shared::formats::{in_the_way, path};
use crate::shared::output_file;
use crate::shared::project_flags::parse_locale;
use crate::shared::settings_file::{Project, SettingsFile};
use crate::shared::sources::PROJECT;
use clap::Args;
use lipz_compiler::settings::Settings;
use lipz_compiler::{Compiler, Content, Input, key};
use lipz_diagnostics::{Code, Report, escape, reports};
use lipz_file::format::{Style, format};
use std::path::{Path, PathBuf};

/// Write a new clip with a text into the project's folder of Lipz files.
///
/// The clip has no mouth shapes yet: `lipz sync` makes them from its recording, `lipz import` from other tools'
/// files.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz new act1/mara-hello \"Good evening, Otto.\"
  lipz new act1/mara-later
  lipz new act1/mara-hello \"Guten Abend, Otto.\" --locale de-de
  lipz new act2/otto-aye \"{tired} Aye. |Aye!\"")]
pub(crate) struct New {
    /// The key of the clip: its path in the folder of Lipz files, without `.lipz`
    #[arg(value_name = "KEY")]
    key: String,

    /// What is said; `|` separates segments [default: nothing yet]
    #[arg(value_name = "TEXT")]
    text: Option<String>,

    /// The locale of the text [default: the project's]
    #[arg(long, value_name = "LOCALE", value_parser = parse_locale)]
    locale: Option<String>,

    #[command(flatten)]
    file: SettingsFile,

    /// The folder of Lipz files [default: the first that lipz.toml names]
    #[arg(short, long, value_name = "FOLDER", help_heading = PROJECT)]
    output: Option<PathBuf>,

    /// Show no summary
    #[arg(short, long)]
    quiet: bool,
}

impl Run for New {
    fn prints_result(&self) -> bool {
        false
    }

    fn run(&self, reporter: &mut Reporter) -> Ended {
        let named: Vec<PathBuf> = self.output.iter().cloned().collect();
        let Project { settings, .. } = self.file.project(&named, reporter)?;
        let Some(locale) = self.locale.as_deref().or(settings.options.get_default_locale()) else {
            let tip = "name it with `--locale`, or set default-locale in lipz.toml";
            return Err(reporter.usage("the locale of the text is not known", tip));
        };
        let folder = self.output.as_deref().or(settings.root.as_deref()).or_else(|| first_folder(&settings));
        let Some(folder) = folder else {
            let tip = "name one with `--output`";
            return Err(reporter.usage("the project names no folder of Lipz files", tip));
        };
        // Who completes a path in a shell names the file.
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
        // That nothing is said yet is no surprise to who asked for it.
        if self.text.is_some() {
            reporter.add(found);
        }
        if !self.quiet {
            reporter.summary(&format!("{} written\n", console::path(&file)))?;
        }
        Ok(Outcome::Clean)
    }
}

/// Why there can be no clip with this key in this file.
fn refusal(key: &str, folder: &Path, settings: &Settings, file: &Path) -> Option<Report> {
    let about = |code, message, help: &str| Some(Report::failure(console::path(file), code, message, help));
    let named = escape::quoted(key);
    if let Some(why) = key::refusal(key) {
        let help = "a key is a path below the folder of Lipz files, such as act1/mara-hello";
        return about(Code::RefusedKey, format!("the key {named} cannot be used: {why}"), help);
    }
    let inside = Path::new(key).strip_prefix(folder).ok().filter(|_| !folder.join(folder).exists());
    if let Some(inside) = inside.filter(|inside| !inside.as_os_str().is_empty()) {
        let help = format!("the key of that file is {}", escape::quoted(&inside.to_string_lossy()));
        return about(Code::RefusedKey, format!("{named} is a path, not a key"), &help);
    }
    if let Some(report) = in_the_way(file) {
        return Some(report);
    }
    let (inputs, _) = settings.discover_with_reports();
    let same = inputs.iter().find(|input| key::folded(&input.key) == key::folded(key))?;
    let message = format!("{named} and {} would be one key", escape::quoted(&same.key));
    about(Code::KeyClash, message, "choose another key")
}

/// The first folder that the project names, whether it is there yet or not.
fn first_folder(settings: &Settings) -> Option<&Path> {
    let is_folder = |path: &&Path| {
        let is_pattern = path.to_string_lossy().contains(['*', '?', '[']);
        path.is_dir() || !path.exists() && !is_pattern && path.extension().is_none()
    };
    settings.sources.iter().map(PathBuf::as_path).find(is_folder)
}

/// The clip in canonical layout.
fn layout(locale: &str, text: &str) -> String {
    let file = format!("{{ \"text_{locale}\": {} }}", lipz_file::literal(text));
    let document = lipz_file::parse(file.as_bytes()).document;
    document
        .map_or(file.clone(), |document| format(&document, Style { default_locale: Some(locale), ..Style::default() }))
}
