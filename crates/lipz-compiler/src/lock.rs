//! One run at a time where several files belong together.

use crate::output::failed;
use crate::temporary::folder_of;
use lipz_diagnostics::Report;
use std::ffi::OsString;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

/// What the name of a lock ends with, which starts with a dot and the name of the file that it is about.
const SUFFIX: &str = ".lipzlock";

/// As long as it lives, no other run that asks for it writes the file that it is about, or those that belong to that. A run that
/// is killed gives it back.
#[derive(Debug)]
pub(crate) struct Lock {
    path: PathBuf,
    file: File,
}

impl Lock {
    /// Waits until the lock for the file at `path` is free, and takes it. Where the file system knows no locks, there is none.
    ///
    /// # Errors
    /// If nothing can be written beside `path`.
    pub(crate) fn wait(path: &Path) -> Result<Lock, Report> {
        Lock::take(path).map_err(|error| failed(path, &error))
    }

    fn take(path: &Path) -> io::Result<Lock> {
        let folder = folder_of(path);
        fs::create_dir_all(folder)?;
        let mut name = OsString::from(".");
        name.push(path.file_name().unwrap_or_default());
        name.push(SUFFIX);
        let path = folder.join(name);
        loop {
            let file = File::options().create(true).truncate(false).write(true).open(&path)?;
            let is_known = loop {
                match file.lock() {
                    Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                    locked => break locked.is_ok(),
                }
            };
            // The run that had it before has removed it by now, and another one may have made it anew.
            if !is_known || is_at(&file, &path) {
                return Ok(Lock { path, file });
            }
        }
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        // Elsewhere, who waits could not tell that it is gone: it stays.
        if cfg!(unix) && is_at(&self.file, &self.path) {
            let _ = fs::remove_file(&self.path);
        }
        let _ = self.file.unlock();
    }
}

/// Whether an open file is the one at `path`.
#[cfg(unix)]
fn is_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let place = |metadata: fs::Metadata| (metadata.dev(), metadata.ino());
    let (open, there) = (file.metadata().map(place), path.metadata().map(place));
    matches!((open, there), (Ok(open), Ok(there)) if open == there)
}

#[cfg(not(unix))]
fn is_at(_file: &File, _path: &Path) -> bool {
    true
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicUsize, Ordering};
    use std::thread;

    #[test]
    fn one_at_a_time_and_nothing_is_left() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("new/d.lipzset");
        let inside = AtomicUsize::new(0);
        thread::scope(|scope| {
            for _ in 0..8 {
                scope.spawn(|| {
                    for _ in 0..20 {
                        let _lock = Lock::wait(&path).unwrap();
                        assert_eq!(inside.fetch_add(1, Ordering::SeqCst), 0);
                        thread::yield_now();
                        inside.fetch_sub(1, Ordering::SeqCst);
                    }
                });
            }
        });
        let left = fs::read_dir(path.parent().unwrap()).unwrap().count();
        assert_eq!(left, if cfg!(unix) { 0 } else { 1 });
    }
}
