//! `lipz print maps`: prints the list of mapping tables, or one table as a file.

use crate::CommandResult;
use crate::Outcome;
use crate::commands::Run;
use crate::reporter::Reporter;
use clap::Args;
use lipz_diagnostics::{Code, Report, escape, suggest};
use lipz_interop::{Map, map_file, maps};
use std::fmt::Write;

/// List the tables that map other tools' mouth shapes to visemes, or print one.
///
/// To make a table of your own, write one to a file, change its rows, and pass it with `--map FILE`.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz print maps
  lipz print maps rhubarb
  lipz print maps papagayo > our-rig.toml")]
pub(crate) struct Maps {
    /// Table to print [default: list all tables]
    #[arg(value_name = "NAME")]
    name: Option<String>,
}

impl Run for Maps {
    fn prints_result(&self) -> bool {
        true
    }

    fn run(&self, reporter: &mut Reporter) -> CommandResult {
        let Some(name) = &self.name else {
            reporter.print(&list())?;
            return Ok(Outcome::Clean);
        };
        match map_file(name) {
            Some(text) => reporter.print(text).map(|()| Outcome::Clean),
            None => {
                let help = match suggest::nearest(name, maps().iter().map(|map| map.name.as_str())) {
                    Some(known) => format!("did you mean `{known}`?"),
                    None => "list the tables with `lipz print maps`".to_owned(),
                };
                let message = format!("{} is not a mapping table", escape::quoted(name));
                Err(reporter.fail(Report::failure("", Code::MapRefused, message, &help)))
            }
        }
    }
}

/// Returns the names of the tables, one per line.
fn list() -> String {
    let width = maps().iter().map(|map| map.name.len()).max().unwrap_or(0);
    let mut text = String::new();
    for map in maps() {
        let Map { name, version, about, viseme_type, .. } = map;
        let lossless = if map.is_lossless() && map.keeps_codes() { ", lossless" } else { "" };
        let _ = writeln!(text, "{name:width$}  version {version}  {:8}  {about}{lossless}", viseme_type.name());
    }
    text
}
