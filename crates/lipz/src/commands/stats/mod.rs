//! `lipz stats`: how much of what is in a bank.

mod json;
mod text;

use crate::Ended;
use crate::Outcome;
use crate::commands::Run;
use crate::reporter::Reporter;
use crate::shared::bank_or_sources::bank_or_sources;
use crate::shared::sources::ProjectArguments;
use crate::shared::text_banks::{TextBanks, TextFiles};
use clap::Args;
use lipz_compiler::BankWithTexts;
use std::path::PathBuf;

/// Show the size of a bank: clips, duration, text, bytes, mouth shapes.
///
/// A folder is compiled in memory, with the flags of `lipz pack`.
#[derive(Args, Debug)]
#[command(override_usage = "lipz stats [BANK] [OPTIONS]")]
#[command(after_help = "Examples:
  lipz stats
  lipz stats dialogue.lipzbank
  lipz stats dialogue.lipzbank --texts dialogue.*.lipztexts
  lipz stats voices --json")]
pub(crate) struct Stats {
    /// A bank, or a folder, file or pattern of Lipz files; `-` is a bank on standard input [default: the
    /// Lipz files of lipz.toml]
    #[arg(value_name = "BANK")]
    bank: Option<PathBuf>,

    #[command(flatten)]
    texts: TextBanks,

    #[command(flatten)]
    project: ProjectArguments,

    /// Print JSON
    #[arg(long)]
    json: bool,
}

impl Run for Stats {
    fn prints_result(&self) -> bool {
        true
    }

    fn run(&self, reporter: &mut Reporter) -> Ended {
        let file = bank_or_sources(self.bank.as_deref(), &self.project, reporter)?;
        let bank = file.bank(reporter)?;
        let text_files = TextFiles::open(&self.texts.texts, reporter)?;
        let texts = text_files.of(&bank, reporter)?;
        let stats = lipz_compiler::stats::Stats::from_bank(BankWithTexts::new(&bank, &texts));
        if self.json {
            reporter.print_json(&json::StatsJson::of(&stats))?;
        } else {
            reporter.print(&text::text(&file.name, &stats))?;
        }
        Ok(Outcome::Clean)
    }
}
