//! The current version for all threads, and waiting for the next one.

use super::version::Version;
use crate::commands::check::translations;
use crate::shared::settings_file::Project;
use crate::shared::sources::retain_own;
use lipz_compiler::Input;
use lipz_diagnostics::Report;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::Duration;

/// The version on display.
pub(super) struct SharedVersion {
    now: Mutex<Arc<Version>>,
    changed: Condvar,
}

impl SharedVersion {
    pub(super) fn new(first: Version) -> SharedVersion {
        SharedVersion { now: Mutex::new(Arc::new(first)), changed: Condvar::new() }
    }

    /// Returns the current version.
    pub(super) fn now(&self) -> Arc<Version> {
        Arc::clone(&self.lock())
    }

    /// Replaces the current version.
    pub(super) fn replace(&self, mut next: Version) {
        let mut now = self.lock();
        next.number = now.number + 1;
        next.keep_bank_of(&now);
        *now = Arc::new(next);
        self.changed.notify_all();
    }

    /// Shows a report about invalid settings. The current version stays on display.
    pub(super) fn tell(&self, report: &Report) {
        let mut now = self.lock();
        let mut next = now.with_only(report);
        next.number = now.number + 1;
        *now = Arc::new(next);
        self.changed.notify_all();
    }

    /// Waits until the version is not `number`, at most as long as `patience`.
    pub(super) fn after(&self, number: u64, patience: Duration) -> Arc<Version> {
        let waited = self.changed.wait_timeout_while(self.lock(), patience, |now| now.number == number);
        let (now, _) = waited.unwrap_or_else(PoisonError::into_inner);
        Arc::clone(&now)
    }

    /// Runs checks in the background that take longer than packing: whether clips match their recordings, and
    /// translations their sources. Adds the results, unless the version has changed by then. With `single` files, the
    /// rest of the project is not checked.
    pub(super) fn look_closer(self: &Arc<SharedVersion>, project: Project, inputs: Vec<Input>, single: bool) {
        let shared = Arc::clone(self);
        let number = shared.now().number;
        let look = move || {
            let mut reports = translations::check(&project, &inputs, true).reports;
            if project.settings.audio.folder.is_some() {
                reports.extend(lipz_sync::check(&project.settings, &inputs, &|| {}));
            }
            if single {
                retain_own(&mut reports);
            }
            shared.add(number, &reports);
        };
        // Without a thread, the page shows only the results of packing.
        let _ = thread::Builder::new().spawn(look);
    }

    fn add(&self, number: u64, reports: &[Report]) {
        let mut now = self.lock();
        if now.number != number || reports.is_empty() {
            return;
        }
        let mut next = now.with(reports);
        next.number = number + 1;
        *now = Arc::new(next);
        self.changed.notify_all();
    }

    fn lock(&self) -> MutexGuard<'_, Arc<Version>> {
        self.now.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
