//! `lipz schema`: the JSON Schema of Lipz files.

use crate::Ended;
use crate::Outcome;
use crate::commands::Run;
use crate::reporter::Reporter;
use clap::Args;

/// Print the JSON Schema of Lipz files, for editors.
///
/// docs/guides/editors.md shows how to make an editor use it.
#[derive(Args, Debug)]
#[command(after_help = "Example:
  lipz schema > lipz.schema.json")]
pub(crate) struct Schema {
    /// Accept any BCP 47 language tag (es-419, zh-hant), not only ll-cc
    #[arg(long)]
    pub(crate) extended_locales: bool,
}

impl Run for Schema {
    fn prints_result(&self) -> bool {
        true
    }

    fn run(&self, reporter: &mut Reporter) -> Ended {
        reporter.print(&lipz_file::schema::json_schema(self.extended_locales))?;
        Ok(Outcome::Clean)
    }
}
