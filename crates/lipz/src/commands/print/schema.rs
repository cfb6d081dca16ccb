//! `lipz print schema`: prints the JSON Schema of Lipz files.

use crate::CommandResult;
use crate::Outcome;
use crate::commands::Run;
use crate::reporter::Reporter;
use crate::shared::settings_file::SettingsFile;
use clap::Args;

/// Print the JSON Schema of Lipz files, for editors.
///
/// With `extended-locales = true` in lipz.toml, it accepts any BCP 47 language tag. docs/guides/editors.md shows how to
/// set up editors.
#[derive(Args, Debug)]
#[command(after_help = "Example:
  lipz print schema > lipz.schema.json")]
pub(crate) struct Schema {
    #[command(flatten)]
    file: SettingsFile,
}

impl Run for Schema {
    fn prints_result(&self) -> bool {
        true
    }

    fn run(&self, reporter: &mut Reporter) -> CommandResult {
        let settings = self.file.project(&[".".into()], reporter)?.settings;
        reporter.print(&lipz_file::schema::json_schema(settings.options.get_extended_locales()))?;
        Ok(Outcome::Clean)
    }
}
