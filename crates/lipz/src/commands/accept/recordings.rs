//! Recordings that say the texts of today.

use super::Accept;
use crate::shared::settings_file::Project;
use crate::{console, interrupt};
use lipz_compiler::Input;
use lipz_diagnostics::{Report, escape};
use lipz_sync::{SyncRecord, Unaccepted, record_place, unaccepted_with_reports};
use std::fmt::Write;

/// The recordings of which nobody has said yet that they say the texts of today, and the record that will know it.
#[derive(Default)]
pub(super) struct Found {
    record: SyncRecord,
    unaccepted: Vec<Unaccepted>,
    pub(super) reports: Vec<Report>,
}

/// Looks for them among the clips that are meant.
///
/// # Errors
/// If the record cannot be read.
pub(super) fn find(accept: &Accept, project: &Project, inputs: &[Input]) -> Result<Found, Report> {
    if project.settings.audio.folder.is_none() {
        return Ok(Found::default());
    }
    let record = SyncRecord::read(&record_place(&project.settings))?;
    let bar = console::progress_bar(inputs.len(), accept.sources.is_quiet());
    let is_meant = |key: &str, locale: Option<&str>| {
        let of_locale = |wanted: &String| locale == Some(wanted);
        accept.is_meant(key) && (accept.locale.is_empty() || accept.locale.iter().any(of_locale))
    };
    let progress = || bar.inc(1);
    let (unaccepted, mut reports) = unaccepted_with_reports(&project.settings, inputs, &record, &is_meant, &progress);
    bar.finish_and_clear();
    reports.extend_from_slice(record.warnings());
    Ok(Found { record, unaccepted, reports })
}

impl Found {
    /// How many there are.
    pub(super) fn count(&self) -> usize {
        self.unaccepted.len()
    }

    /// Accepts them, and says which of them said something else before.
    pub(super) fn accept(&mut self, said: &mut String) {
        for one in &self.unaccepted {
            if one.is_outdated {
                let (key, recording) = (escape::text(&one.key), escape::text(&one.recording));
                let _ = writeln!(said, "{key}: {recording} says the text of today, before another one");
            }
            one.accept(&mut self.record);
        }
    }

    /// What is accepted, in numbers; nothing if that is nothing.
    pub(super) fn summary(&self) -> String {
        if self.unaccepted.is_empty() {
            return String::new();
        }
        let outdated = self.unaccepted.iter().filter(|one| one.is_outdated).count();
        format!(
            "{} with another text before, {} of which nothing was known\n",
            console::counted(outdated, "recording"),
            console::counted(self.unaccepted.len() - outdated, "recording")
        )
    }

    /// Writes the record, if something was accepted.
    ///
    /// # Errors
    /// If it cannot be written.
    pub(super) fn write(&self) -> Result<(), Report> {
        if self.unaccepted.is_empty() { Ok(()) } else { interrupt::whole(|| self.record.write()) }
    }
}
