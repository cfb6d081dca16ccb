//! `lipz inspect --show stats`: statistics of a bank's contents.

mod recorded;
mod text;

use crate::Abort;
use crate::CommandResult;
use crate::Outcome;
use crate::reporter::Reporter;
use crate::shared::bank_or_sources::DialogueArguments;
use crate::shared::dialogue_files::DialogueFiles;
use crate::shared::inputs::find;
use lipz_diagnostics::reports::have_errors;
use lipz_sync::RecordingCounts;

/// Prints the statistics of a dialogue.
pub(super) fn run(dialogue: &DialogueArguments, key: Option<&str>, reporter: &mut Reporter) -> CommandResult {
    if key.is_some() {
        return Err(reporter.usage("`--show stats` covers all clips, but one is named", "leave out the key"));
    }
    let (named, recorded) = files_and_recorded(dialogue, reporter)?;
    let files = named.verified(reporter)?;
    let dialogue = named.bounded_dialogue(&files, reporter)?;
    let stats = lipz_compiler::stats::Stats::from_dialogue(&dialogue);
    if reporter.wants_json() {
        reporter.print_json(&recorded::StatsWithRecordings { stats: &stats, recorded: recorded.map(Into::into) })?;
    } else {
        reporter.print(&text::text(&named.name, &stats, recorded.as_ref()))?;
    }
    Ok(Outcome::Clean)
}

/// Returns the files, and how many of the Lipz files are recorded, if their project has recordings.
fn files_and_recorded(
    dialogue: &DialogueArguments,
    reporter: &mut Reporter,
) -> Result<(DialogueFiles, Option<RecordingCounts>), Abort> {
    if let Some(bank) = dialogue.bank_without_options(reporter)? {
        return Ok((DialogueFiles::open(bank, reporter)?, None));
    }
    let project = dialogue.project(reporter)?;
    let files = dialogue.files_of(&project, reporter)?;
    let (inputs, _) = find(&project.settings);
    let (recorded, reports) = RecordingCounts::count_with_reports(&project.settings, &inputs);
    if have_errors(&reports) {
        let outcome = Outcome::from_reports(&reports);
        return Err(reporter.abort(reports, outcome));
    }
    reporter.add(reports);
    Ok((files, recorded))
}
