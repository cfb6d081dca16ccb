//! What is shown now, for all threads; and waiting for something newer.

use super::version::Version;
use crate::commands::check::translations;
use crate::shared::settings_file::Project;
use crate::shared::sources::retain_own;
use lipz_compiler::Input;
use lipz_diagnostics::Report;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::Duration;

/// The version that is shown.
pub(super) struct Shared {
    now: Mutex<Arc<Version>>,
    changed: Condvar,
}

impl Shared {
    pub(super) fn new(first: Version) -> Shared {
        Shared { now: Mutex::new(Arc::new(first)), changed: Condvar::new() }
    }

    /// What is shown now.
    pub(super) fn now(&self) -> Arc<Version> {
        Arc::clone(&self.lock())
    }

    /// Shows another version from now on.
    pub(super) fn replace(&self, mut next: Version) {
        let mut now = self.lock();
        next.number = now.number + 1;
        next.keep_bank_of(&now);
        *now = Arc::new(next);
        self.changed.notify_all();
    }

    /// Tells what is wrong with the settings, which are not taken: what is shown stays.
    pub(super) fn tell(&self, report: &Report) {
        let mut now = self.lock();
        let mut next = now.with_only(report);
        next.number = now.number + 1;
        *now = Arc::new(next);
        self.changed.notify_all();
    }

    /// Waits until there is another version than `number`, but not for ever.
    pub(super) fn after(&self, number: u64, patience: Duration) -> Arc<Version> {
        let waited = self.changed.wait_timeout_while(self.lock(), patience, |now| now.number == number);
        let (now, _) = waited.unwrap_or_else(PoisonError::into_inner);
        Arc::clone(&now)
    }

    /// Looks, beside everything else, for what takes longer than packing: whether clips fit their recordings, and
    /// translations their sources. What it finds is added, unless the version is another one by then. Of `single` files, the
    /// rest of the project is not known.
    pub(super) fn look_closer(self: &Arc<Shared>, project: Project, inputs: Vec<Input>, single: bool) {
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
        // Without a thread, the page shows what packing found.
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
