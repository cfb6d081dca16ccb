//! `lipz print babble`: prints the babble profile of a Second Life viewer as project settings.

use crate::CommandResult;
use crate::commands::Run;
use crate::reporter::Reporter;
use crate::shared::input_file;
use crate::shared::stdio;
use crate::{Outcome, console};
use clap::Args;
use lipz_bank::Fps;
use lipz_bank::babble::Babble;
use lipz_compiler::settings::is_word;
use lipz_diagnostics::Report;
use lipz_interop::second_life::{LipSync, lip_sync};
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// Print the babble profile of a Second Life viewer, for lipz.toml.
///
/// Viewers of Second Life store changed settings in user_settings/settings.xml. For all others, lipz prints the viewer's
/// defaults.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz print babble settings.xml >> lipz.toml
  lipz print babble settings.xml robot >> lipz.toml")]
pub(crate) struct BabbleArguments {
    /// Settings file of the viewer; `-` is standard input
    #[arg(value_name = "SETTINGS")]
    pub(crate) settings: PathBuf,

    /// Name of the profile [default: none, the project's own profile]
    #[arg(value_name = "NAME", value_parser = name)]
    pub(crate) name: Option<String>,
}

/// Returns a name that needs no quotes in the header of a TOML table.
fn name(text: &str) -> Result<String, String> {
    let is_bare = text.chars().all(|c| c.is_ascii_alphanumeric() || matches!(c, '-' | '_'));
    if is_word(text) && is_bare { Ok(text.to_owned()) } else { Err("use only letters, digits, - and _".to_owned()) }
}

impl Run for BabbleArguments {
    fn prints_result(&self) -> bool {
        true
    }

    fn run(&self, reporter: &mut Reporter) -> CommandResult {
        let path = &self.settings;
        let (shown, bytes) = read(path).map_err(|report| reporter.fail(report))?;
        let mut diagnostics = Vec::new();
        let settings = lip_sync(&bytes, &shown, &mut diagnostics);
        let report = Report::from_bytes(&shown, &bytes, diagnostics);
        let has_errors = report.has_errors();
        let found = if report.diagnostics.is_empty() { Vec::new() } else { vec![report] };
        match settings {
            Some(settings) if !has_errors => {
                reporter.add(found);
                reporter.print(&toml(&settings, self.name.as_deref()))?;
                Ok(Outcome::Clean)
            }
            _ => Err(reporter.refuse(found)),
        }
    }
}

/// Returns the file's name for messages, and its bytes.
fn read(path: &Path) -> Result<(String, Vec<u8>), Report> {
    if stdio::is_meant(path) {
        return Ok((stdio::input_name(), stdio::lipz_bytes()?));
    }
    let bytes = input_file::read(path).map_err(|error| input_file::unreadable(path, &error))?;
    Ok((console::path(path), bytes))
}

/// Returns the settings as a complete profile for lipz.toml.
fn toml(settings: &LipSync, name: Option<&str>) -> String {
    let mut text = match name {
        Some(name) => format!("[babble.{name}]\n"),
        None => "[babble]\n".to_owned(),
    };
    let built_in = Babble::DEFAULT;
    for (key, own, default) in [
        ("ooh", &settings.ooh, built_in.ooh()),
        ("aah", &settings.aah, built_in.aah()),
        ("ooh-power-transfer", &settings.ooh_power_transfer, built_in.ooh_power_transfer()),
        ("aah-power-transfer", &settings.aah_power_transfer, built_in.aah_power_transfer()),
    ] {
        let default = || String::from_utf8_lossy(default).into_owned();
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{key} = \"{}\"", own.as_ref().map_or_else(default, ToString::to_string));
    }
    let rate = settings.rate.and_then(|rate| Fps::new(rate.numerator, rate.denominator));
    let _ = writeln!(text, "rate = {}", rate.unwrap_or(built_in.rate()));
    text
}
