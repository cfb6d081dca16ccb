//! Exclusive access for one run to files that belong together.

use crate::files::output::failed;
use crate::files::path::display;
use crate::files::temporary::folder_of;
use lipz_diagnostics::{Code, Report};
use std::ffi::OsString;
use std::fs::{self, File, TryLockError};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use std::{io, thread};

/// The suffix of lock files. Their names start with a dot and the name of the locked file.
const SUFFIX: &str = ".lipzlock";

/// A lock on a file and those that belong to it. While it exists, other runs that request it do not write them. The
/// system releases it if the run is killed.
#[derive(Debug)]
pub(crate) struct Lock(Option<(PathBuf, File)>);

/// The longest wait of runs that the user cannot stop.
const PATIENCE: Duration = Duration::from_secs(30);
const PAUSE: Duration = Duration::from_millis(50);

impl Lock {
    /// Waits for the lock on the file at `path`. Without locks in the file system, or without permission to write,
    /// returns an empty lock: writing then reports the error.
    ///
    /// # Errors
    /// If the lock file or its folder cannot be created for other reasons, or if the lock belongs to another user and
    /// cannot be opened.
    #[cfg(any(feature = "shards", test))]
    pub(crate) fn wait(path: &Path) -> Result<Lock, Report> {
        Lock::take(path, |file| file.lock().map(|()| true))
    }

    /// Waits for the lock, at most half a minute.
    ///
    /// # Errors
    /// Those of [`wait`](Self::wait), and if another run still has the lock.
    pub(crate) fn wait_briefly(path: &Path) -> Result<Lock, Report> {
        let until = Instant::now() + PATIENCE;
        Lock::take(path, |file| {
            loop {
                match file.try_lock() {
                    Ok(()) => return Ok(true),
                    Err(TryLockError::Error(error)) => return Err(error),
                    Err(TryLockError::WouldBlock) if Instant::now() > until => return Ok(false),
                    Err(TryLockError::WouldBlock) => thread::sleep(PAUSE),
                }
            }
        })
    }

    /// Takes the lock with `lock`, which returns false if it would wait too long.
    fn take(path: &Path, lock: impl Fn(&File) -> io::Result<bool>) -> Result<Lock, Report> {
        let folder = folder_of(path);
        let mut name = OsString::from(".");
        name.push(path.file_name().unwrap_or_default());
        name.push(SUFFIX);
        let place = folder.join(name);
        let attempt = || fs::create_dir_all(folder).and_then(|()| Lock::locked(&place, &lock));
        let is_there = || place.symlink_metadata().is_ok();
        let is_refused = |error: &io::Error| {
            matches!(error.kind(), io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem) && !is_there()
        };
        let taken = match attempt() {
            // Its previous owner may have removed it between two attempts.
            Err(error) if is_refused(&error) => attempt(),
            taken => taken,
        };
        match taken {
            Ok(Some(file)) => Ok(Lock(Some((place, file)))),
            Ok(None) => {
                let help = "run the command again when the other run has ended";
                Err(held(path, "another run has been writing it for half a minute", help))
            }
            Err(error) if is_refused(&error) => Ok(Lock(None)),
            Err(error) if is_there() => {
                let why = format!("its lock `{}` cannot be opened: {error}", display(&place));
                Err(held(path, &why, "wait for the other user's run, or delete that file if no run is in progress"))
            }
            Err(error) => Err(failed(path, &error)),
        }
    }

    /// Returns the file at `place`, locked if the file system supports locks; `None` if `lock` would wait too long.
    fn locked(place: &Path, lock: impl Fn(&File) -> io::Result<bool>) -> io::Result<Option<File>> {
        loop {
            let made = File::options().create(true).truncate(false).write(true).open(place);
            let may_write = made.is_ok();
            // A lock file left by another user can usually still be locked.
            let file = made.or_else(|error| File::open(place).map_err(|_| error))?;
            let is_known = loop {
                match lock(&file) {
                    Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                    Err(error) if !may_write => return Err(error),
                    Err(_) => break false,
                    Ok(false) => return Ok(None),
                    Ok(true) => break true,
                }
            };
            // The previous owner has removed it by now, and another run may have created a new one.
            if !is_known || is_at(&file, place) {
                return Ok(Some(file));
            }
        }
    }
}

/// Returns the report that the file at `path` is not written because another run may be writing it.
fn held(path: &Path, why: &str, help: &str) -> Report {
    let shown = display(path);
    let message = format!("`{shown}` cannot be written: {why}");
    Report::failure(shown, Code::OutputFailed, message, help)
}

impl Drop for Lock {
    fn drop(&mut self) {
        let Some((path, file)) = &self.0 else { return };
        // On other systems, waiting runs could not detect the removal. Leave the file.
        if cfg!(unix) && is_at(file, path) {
            let _ = fs::remove_file(path);
        }
        let _ = file.unlock();
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

    #[test]
    fn one_at_a_time_and_nothing_is_left() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("new/d.lipzset");
        let inside = AtomicUsize::new(0);
        thread::scope(|scope| {
            for _ in 0..8 {
                scope.spawn(|| {
                    for _ in 0..20 {
                        let wait = if inside.load(Ordering::SeqCst) == 0 { Lock::wait } else { Lock::wait_briefly };
                        let _lock = wait(&path).unwrap();
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

    #[test]
    #[cfg(unix)]
    fn what_another_user_left_can_be_locked_and_a_folder_for_nobody_needs_no_lock() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("d.lipzset");
        let left = folder.path().join(".d.lipzset.lipzlock");
        fs::write(&left, "").unwrap();
        fs::set_permissions(&left, fs::Permissions::from_mode(0o444)).unwrap();
        assert!(Lock::wait(&path).unwrap().0.is_some());
        assert!(!left.exists());
        fs::write(&left, "").unwrap();
        fs::set_permissions(&left, fs::Permissions::from_mode(0o000)).unwrap();
        // Root may read and write everywhere.
        let is_root = fs::read(&left).is_ok();
        assert_eq!(Lock::wait(&path).is_ok(), is_root, "a lock that cannot be opened may be held");
        fs::set_permissions(folder.path(), fs::Permissions::from_mode(0o555)).unwrap();
        assert_eq!(Lock::wait(&folder.path().join("other")).unwrap().0.is_some(), is_root);
        fs::set_permissions(folder.path(), fs::Permissions::from_mode(0o755)).unwrap();
    }
}
