//! `lipz maps`: the mapping tables, as a list or one as a file.

use crate::Ended;
use crate::Outcome;
use crate::commands::Run;
use crate::reporter::Reporter;
use clap::Args;
use lipz_diagnostics::{Code, Report, escape, suggest};
use lipz_interop::{Map, map_file, maps};
use std::fmt::Write;

/// List the tables that map other tools' mouth shapes to Lipz codes, or print one.
///
/// To make your own, print one to a file, change its rows, and use it with `--map FILE`.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz maps
  lipz maps rhubarb
  lipz maps papagayo > our-rig.toml")]
pub(crate) struct Maps {
    /// The table to print
    #[arg(value_name = "NAME")]
    name: Option<String>,
}

impl Run for Maps {
    fn prints_result(&self) -> bool {
        true
    }

    fn run(&self, reporter: &mut Reporter) -> Ended {
        let Some(name) = &self.name else {
            reporter.print(&list())?;
            return Ok(Outcome::Clean);
        };
        match map_file(name) {
            Some(text) => reporter.print(text).map(|()| Outcome::Clean),
            None => {
                let help = match suggest::nearest(name, maps().iter().map(|map| map.name.as_str())) {
                    Some(known) => format!("did you mean `{known}`?"),
                    None => "`lipz maps` lists the tables".to_owned(),
                };
                let message = format!("{} is not a mapping table", escape::quoted(name));
                Err(reporter.fail(Report::failure("", Code::MapRefused, message, &help)))
            }
        }
    }
}

/// The tables, one a line.
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
