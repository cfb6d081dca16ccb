//! The text banks of a bank that was split by locale: one argument for all commands that read banks.

use clap::Args;
use std::path::PathBuf;

/// The text banks of the bank that a command reads.
#[derive(Args, Debug)]
pub(crate) struct TextBanks {
    /// Text banks of the bank, which comes before them: their locales are added to its own
    #[arg(long, value_name = "FILE", num_args = 1..)]
    pub(crate) texts: Vec<PathBuf>,
}
