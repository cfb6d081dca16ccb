//! Approval of recordings that match the current texts.

use super::{Approve, head};
use crate::shared::settings_file::Project;
use crate::{console, interrupt};
use lipz_compiler::Input;
use lipz_diagnostics::{Report, escape};
use lipz_sync::{SyncRecord, UnapprovedRecording, record_place, unapproved_with_reports};
use std::fmt::Write;

/// The recordings that are not yet approved for the current texts, and the record to update.
#[derive(Default)]
pub(super) struct RecordingApproval {
    record: SyncRecord,
    unapproved: Vec<UnapprovedRecording>,
    pub(super) reports: Vec<Report>,
}

/// Finds them among the selected clips.
///
/// # Errors
/// If the record cannot be read.
pub(super) fn find(approve: &Approve, project: &Project, inputs: &[Input]) -> Result<RecordingApproval, Report> {
    if project.settings.audio.folder.is_none() {
        return Ok(RecordingApproval::default());
    }
    let record = SyncRecord::read(&record_place(&project.settings))?;
    let bar = console::progress_bar(inputs.len(), approve.sources.is_quiet());
    let is_meant = |_: &str, locale: Option<&str>| {
        let of_locale = |wanted: &String| locale == Some(wanted);
        approve.locale.is_empty() || approve.locale.iter().any(of_locale)
    };
    let progress = || bar.inc(1);
    let (unapproved, mut reports) = unapproved_with_reports(&project.settings, inputs, &record, &is_meant, &progress);
    bar.finish_and_clear();
    reports.extend_from_slice(record.warnings());
    Ok(RecordingApproval { record, unapproved, reports })
}

impl RecordingApproval {
    /// Returns the number of recordings.
    pub(super) fn count(&self) -> usize {
        self.unapproved.len()
    }

    /// Approves the recordings, and adds those with a changed text to `said`.
    pub(super) fn approve(&mut self, said: &mut String) {
        for one in &self.unapproved {
            if one.is_outdated {
                let (key, recording) = (escape::text(&one.key), escape::text(&one.recording));
                let _ = writeln!(said, "{key}: {recording} (its text has changed)");
            }
            one.approve(&mut self.record);
        }
    }

    /// Returns the numbers of approved recordings, or an empty string if there are none.
    pub(super) fn summary(&self, is_check: bool) -> String {
        if self.unapproved.is_empty() {
            return String::new();
        }
        let outdated = self.unapproved.iter().filter(|one| one.is_outdated).count();
        format!(
            "{}: {} with a changed text, {}\n",
            head(is_check),
            console::counted(outdated, "recording"),
            console::counted(self.unapproved.len() - outdated, "new recording")
        )
    }

    /// Writes the record if a recording was approved.
    ///
    /// # Errors
    /// If it cannot be written.
    pub(super) fn write(&self) -> Result<(), Report> {
        if self.unapproved.is_empty() { Ok(()) } else { interrupt::whole(|| self.record.write()) }
    }
}
