//! Ctrl-C and requests to end: they are obeyed at once, but not between the start and the end of
//! writing a file, so that no half-written one is left behind.

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

/// The exit code of an interrupted run: 128 and the number of the signal that Ctrl-C sends.
const EXIT_CODE: i32 = 128 + 2;

/// Held while files are written.
static WRITING: Mutex<()> = Mutex::new(());
/// Whether the run was asked to end.
static IS_ASKED: AtomicBool = AtomicBool::new(false);

/// Files of the command that are written and not yet replaced: temporary ones, which nobody may leave behind.
static WAITING: Mutex<Option<Arc<Replacements>>> = Mutex::new(None);

/// Replaces many files, in groups. What waits is given up when the process is asked to end.
pub(crate) struct Files(Arc<Replacements>);

impl Files {
    /// None yet. A command has one of these at a time.
    pub(crate) fn new() -> Files {
        let files = Arc::new(Replacements::default());
        *WAITING.lock().unwrap_or_else(PoisonError::into_inner) = Some(Arc::clone(&files));
        Files(files)
    }

    /// As [`Replacements::replace`].
    pub(crate) fn replace(&self, path: &Path, bytes: &[u8]) -> Result<(), Report> {
        whole(|| self.0.replace(path, bytes))
    }

    /// As [`Replacements::rewrite`].
    pub(crate) fn rewrite(&self, path: &Path, before: &[u8], after: &[u8]) -> Result<(), Report> {
        whole(|| self.0.rewrite(path, before, after))
    }

    /// What waits, for a [`whole_files`] run that writes all of its files.
    pub(crate) fn waiting(&self) -> &Replacements {
        &self.0
    }

    /// As [`Replacements::finish`].
    pub(crate) fn finish(&self) -> Vec<Report> {
        whole(|| self.0.finish())
    }
}

/// What still waits is given up, as after an error: no temporary file is left.
impl Drop for Files {
    fn drop(&mut self) {
        self.0.abandon();
        let mut waiting = WAITING.lock().unwrap_or_else(PoisonError::into_inner);
        if waiting.as_ref().is_some_and(|files| Arc::ptr_eq(files, &self.0)) {
            *waiting = None;
        }
    }
}

/// Ends the process when it is asked to; waits for files that are being written.
pub(crate) fn listen() {
    on_request(|| {
        IS_ASKED.store(true, Ordering::SeqCst);
        let _nothing_is_open = writing();
        end();
    });
}

#[cfg(not(unix))]
fn on_request(end: impl FnMut() + Send + 'static) {
    // Where the system refuses a handler, Ctrl-C ends the process by itself.
    let _ = ctrlc::set_handler(end);
}

/// Runs `write`, which leaves no file half-written when it returns; ends the process after it if that was asked for
/// meanwhile.
pub(crate) fn whole<R>(write: impl FnOnce() -> R) -> R {
    whole_files(|_| write())
}

/// The same with many files, which `write` writes one after another: it calls what it is given between two of them, and
/// there the process may end. Nobody else can: while one thread writes, others have no say.
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
    // A run that panicked while it wrote has removed its temporary file on the way out.
    WRITING.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Ends the process. Who calls it holds `WRITING`, so that nobody else writes or ends it, too.
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
