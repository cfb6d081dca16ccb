//! The checks that run once a file has become a clip, in the order of their reports. Each file of checks has a list, so
//! a new file needs one more line here.

use super::trigger::{Check, CheckedClip, CheckedText, CleanFile, Run, Trigger};
use super::{blank, closed_lips, readability, texts, variants, visemes};
use crate::project::Options;
use lipz_diagnostics::Diagnostic;

const LISTS: [&[Check]; 6] =
    [texts::CHECKS, readability::CHECKS, visemes::CHECKS, blank::CHECKS, variants::CHECKS, closed_lips::CHECKS];

fn all() -> impl Iterator<Item = &'static Check> {
    LISTS.into_iter().flatten()
}

/// Runs the checks of a text element.
pub(super) fn run_on_text(text: &CheckedText<'_>, diagnostics: &mut Vec<Diagnostic>) {
    for check in all() {
        if let Run::Text(run) = check.run {
            run(text, diagnostics);
        }
    }
}

/// Runs the checks of a clip.
pub(super) fn run_on_clip(clip: &CheckedClip<'_>, diagnostics: &mut Vec<Diagnostic>) {
    for check in all() {
        if let Run::Clip(run) = check.run {
            run(clip, diagnostics);
        }
    }
}

/// Whether a check may report something about any file of a project.
pub(super) fn may_report_all(options: &Options) -> bool {
    all().any(|check| matches!(check.trigger, Trigger::Options(may_report) if may_report(options)))
}

/// Whether a check may report something about a file.
pub(super) fn may_report(file: &CleanFile<'_>) -> bool {
    all().any(|check| matches!(check.trigger, Trigger::File(may_report) if may_report(file)))
}
