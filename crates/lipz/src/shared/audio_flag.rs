//! `--audio`: the folder of a project's recordings. All other settings about them are in `[audio]` of lipz.toml.

use crate::console;
use crate::reporter::{Abort, Reporter};
use clap::Args;
use lipz_compiler::settings::Audio;
use lipz_diagnostics::{Code, Report};
use std::path::PathBuf;

/// The option that overrides `folder` of `[audio]`.
#[derive(Args, Clone, Debug, Default)]
pub(crate) struct AudioFlag {
    /// Folder of the recordings [default: `folder` of [audio]]
    #[arg(long, value_name = "FOLDER")]
    audio: Option<PathBuf>,
}

impl AudioFlag {
    /// Replaces the folder of the settings, if the flag is used.
    ///
    /// # Errors
    /// If the flag names something other than a folder. The command cannot do what was asked for.
    pub(crate) fn apply(&self, audio: &mut Audio, reporter: &mut Reporter) -> Result<(), Abort> {
        let Some(folder) = &self.audio else { return Ok(()) };
        if !folder.is_dir() {
            let shown = console::path(folder);
            let what = if folder.exists() { "is not a folder" } else { "does not exist" };
            let help = "check the spelling of the path after `--audio`";
            let message = format!("`{shown}` {what}");
            return Err(reporter.fail(Report::failure(shown, Code::UnreadableFile, message, help)));
        }
        audio.folder = Some(folder.clone());
        Ok(())
    }
}
