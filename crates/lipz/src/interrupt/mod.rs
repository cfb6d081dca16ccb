//! Ctrl-C and other requests to end. They take effect immediately, except while a file is being written, so that no
//! half-written file is left behind.

#[cfg(unix)]
mod unix;

use crate::console;
use lipz_compiler::Replacements;
use lipz_diagnostics::Report;
use std::path::Path;
use std::process;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
#[cfg(unix)]
use unix::on_request;

/// The exit code of an interrupted run: 128 plus the number of the signal that Ctrl-C sends.
const EXIT_CODE: i32 = 128 + 2;

/// Held while files are written.
static WRITING: Mutex<()> = Mutex::new(());
/// Whether the process has been asked to end.
static IS_ASKED: AtomicBool = AtomicBool::new(false);

/// Written temporary files of the command that have not yet replaced their targets. They must not be left behind.
static WAITING: Mutex<Option<Arc<Replacements>>> = Mutex::new(None);

/// Replaces many files in groups. Pending replacements are discarded when the process is asked to end.
pub(crate) struct Files(Arc<Replacements>);

impl Files {
    /// Creates an empty list. A command has only one of these at a time.
    pub(crate) fn new() -> Files {
        let files = Arc::new(Replacements::default());
        *WAITING.lock().unwrap_or_else(PoisonError::into_inner) = Some(Arc::clone(&files));
        Files(files)
    }

    /// See [`Replacements::replace`].
    pub(crate) fn replace(&self, path: &Path, bytes: &[u8]) -> Result<(), Report> {
        whole(|| self.0.replace(path, bytes))
    }

    /// See [`Replacements::rewrite`].
    pub(crate) fn rewrite(&self, path: &Path, before: &[u8], after: &[u8]) -> Result<(), Report> {
        whole(|| self.0.rewrite(path, before, after))
    }

    /// Returns the pending replacements, for a [`whole_files`] run that writes all of its files.
    pub(crate) fn waiting(&self) -> &Replacements {
        &self.0
    }

    /// See [`Replacements::finish`].
    pub(crate) fn finish(&self) -> Vec<Report> {
        whole(|| self.0.finish())
    }
}

/// Discards pending replacements, as after an error, so that no temporary file is left.
impl Drop for Files {
    fn drop(&mut self) {
        self.0.abandon();
        let mut waiting = WAITING.lock().unwrap_or_else(PoisonError::into_inner);
        if waiting.as_ref().is_some_and(|files| Arc::ptr_eq(files, &self.0)) {
            *waiting = None;
        }
    }
}

/// Ends the process on request, after files that are being written.
pub(crate) fn listen() {
    on_request(|| {
        IS_ASKED.store(true, Ordering::SeqCst);
        let _nothing_is_open = writing();
        end();
    });
}

#[cfg(not(unix))]
fn on_request(end: impl FnMut() + Send + 'static) {
    // If the system refuses a handler, Ctrl-C ends the process directly.
    let _ = ctrlc::set_handler(end);
}

/// Runs `write`, which must not leave a half-written file. Afterwards, ends the process if that was requested in
/// between.
pub(crate) fn whole<R>(write: impl FnOnce() -> R) -> R {
    whole_files(|_| write())
}

/// Runs `write`, which writes many files in sequence. It calls its argument between two files, and only there may the
/// process end: while one thread writes, other threads cannot end the process.
pub(crate) fn whole_files<R>(write: impl FnOnce(&dyn Fn()) -> R) -> R {
    let _held = writing();
    let written = write(&end_if_asked);
    end_if_asked();
    written
}

fn end_if_asked() {
    if IS_ASKED.load(Ordering::SeqCst) {
        end();
    }
}

fn writing() -> MutexGuard<'static, ()> {
    // A run that panicked while writing has already removed its temporary file.
    WRITING.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Ends the process. Callers hold `WRITING`, so that no other thread writes or ends the process as well.
fn end() -> ! {
    if let Some(files) = WAITING.lock().unwrap_or_else(PoisonError::into_inner).take() {
        files.abandon();
    }
    console::remark_below_progress("interrupted\n");
    process::exit(EXIT_CODE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_leaves_no_temporary_file() {
        let folder = tempfile::tempdir().unwrap();
        let files = Files::new();
        files.replace(&folder.path().join("a"), b"new").unwrap();
        assert_eq!(folder.path().read_dir().unwrap().count(), 1);
        drop(files);
        assert_eq!(folder.path().read_dir().unwrap().count(), 0);
    }
}
