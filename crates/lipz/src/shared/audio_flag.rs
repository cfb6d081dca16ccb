//! `--audio`: the folder of a project's recordings. All other settings about them are in `[audio]` of lipz.toml.

use clap::Args;
use lipz_compiler::settings::Audio;
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
    pub(crate) fn apply(&self, audio: &mut Audio) {
        audio.folder = self.audio.clone().or(audio.folder.take());
    }
}
