//! `lipz inspect --show stats`: statistics of a bank's contents.

mod recorded;
mod text;

use crate::CommandResult;
use crate::Outcome;
use crate::reporter::Reporter;
use crate::shared::bank_or_sources::DialogueArguments;

/// Prints the statistics of a dialogue.
pub(super) fn run(dialogue: &DialogueArguments, key: Option<&str>, reporter: &mut Reporter) -> CommandResult {
    if key.is_some() {
        return Err(reporter.usage("`--show stats` covers all clips, but one is named", "leave out the key"));
    }
    let (named, recorded) = dialogue.files_and_recorded(reporter)?;
    let files = named.verified(reporter)?;
    let dialogue = named.dialogue(&files, reporter)?;
    let stats = lipz_compiler::stats::Stats::from_dialogue(&dialogue);
    if reporter.wants_json() {
        reporter.print_json(&recorded::StatsWithRecordings { stats: &stats, recorded: recorded.map(Into::into) })?;
    } else {
        reporter.print(&text::text(&named.name, &stats, recorded.as_ref()))?;
    }
    Ok(Outcome::Clean)
}
