//! `lipz stats`: how much of what is in a bank.

mod recorded;
mod text;

use crate::Ended;
use crate::Outcome;
use crate::commands::Run;
use crate::reporter::Reporter;
use crate::shared::bank_or_sources::DialogueArguments;
use clap::Args;

/// Show the size of a bank or a set: clips, duration, text, bytes, mouth shapes.
///
/// A folder is compiled in memory, with the flags of `lipz pack`. If its project has recordings (`[audio]`), they are
/// counted, too: those that are missing, those that no clip uses, and the words that `lipz sync` did not hear clearly.
#[derive(Args, Debug)]
#[command(override_usage = "lipz stats [BANK] [OPTIONS]")]
#[command(after_help = "Examples:
  lipz stats
  lipz stats dialogue.lipzbank
  lipz stats dialogue.lipzset
  lipz stats dialogue.lipzbank --texts dialogue.*.lipztexts
  lipz stats voices --json")]
pub(crate) struct Stats {
    #[command(flatten)]
    dialogue: DialogueArguments,

    /// Print JSON
    #[arg(long)]
    json: bool,
}

impl Run for Stats {
    fn prints_result(&self) -> bool {
        true
    }

    fn run(&self, reporter: &mut Reporter) -> Ended {
        let (named, recorded) = self.dialogue.files_and_recorded(reporter)?;
        let files = named.verified(reporter)?;
        let dialogue = named.dialogue(&files, reporter)?;
        let stats = lipz_compiler::stats::Stats::from_dialogue(&dialogue);
        if reporter.wants_json(self.json) {
            reporter.print_json(&recorded::WithRecorded { stats: &stats, recorded: recorded.map(Into::into) })?;
        } else {
            reporter.print(&text::text(&named.name, &stats, recorded.as_ref()))?;
        }
        Ok(Outcome::Clean)
    }
}
