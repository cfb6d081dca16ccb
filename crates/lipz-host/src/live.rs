//! A bank whose file is replaced while the program runs.

use crate::stamp::Stamp;
use crate::{Error, FileBytes, Hold, OwnedBank};
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError, RwLock};

/// A bank that follows its file: [`refresh`](LiveBank::refresh) takes in a new version of it once that is
/// verified, and keeps the old one if it is damaged.
///
/// Any thread may refresh, any number may read. Who holds a version reads on from it, also when it is no
/// longer the current one; the last who lets it go frees it.
#[derive(Debug)]
pub struct LiveBank {
    path: PathBuf,
    hold: Hold,
    current: RwLock<Arc<OwnedBank>>,
    /// What the file looked like that needs no second look, used or refused.
    seen: Mutex<Option<Stamp>>,
}

impl LiveBank {
    /// Opens and verifies the bank at `path`.
    ///
    /// # Errors
    /// When the file cannot be opened, is no bank, or a damaged one.
    pub fn open(path: impl Into<PathBuf>, hold: Hold) -> Result<LiveBank, Error> {
        let path = path.into();
        let file = File::open(&path)?;
        let stamp = Stamp::of(&file.metadata()?);
        let current = RwLock::new(Arc::new(verified(&file, hold)?));
        Ok(LiveBank { path, hold, current, seen: Mutex::new(Some(stamp)) })
    }

    /// The current version. Keep it for as long as what you do with it should not change: a
    /// conversation, a frame.
    pub fn current(&self) -> Arc<OwnedBank> {
        Arc::clone(&self.current.read().unwrap_or_else(PoisonError::into_inner))
    }

    /// Looks whether the file was replaced, and takes in the new version: whether there is one.
    ///
    /// As long as the file looks the same (one `stat`), this costs nothing worth mentioning. A new version is
    /// verified first, which reads all of it: call this where a pause of some milliseconds does not hurt,
    /// or from a thread of your own.
    ///
    /// # Errors
    /// Why the file cannot be used; the old version stays the current one. A damaged file is refused once
    /// more with every call while it is younger than two seconds, for it may still be written, and then not
    /// again until it changes. A missing one is refused every time.
    pub fn refresh(&self) -> Result<bool, Error> {
        // Held until the end: one version after the other.
        let mut seen = self.seen.lock().unwrap_or_else(PoisonError::into_inner);
        if *seen == Some(Stamp::of(&fs::metadata(&self.path)?)) {
            return Ok(false);
        }
        let file = File::open(&self.path)?;
        // Of the very file that is read: the path may lead to the next one by now.
        let stamp = Stamp::of(&file.metadata()?);
        match verified(&file, self.hold) {
            Ok(bank) => {
                *self.current.write().unwrap_or_else(PoisonError::into_inner) = Arc::new(bank);
                *seen = Some(stamp);
                Ok(true)
            }
            Err(error) => {
                *seen = stamp.is_settled().then_some(stamp);
                Err(error)
            }
        }
    }

    /// The path of the file.
    pub fn path(&self) -> &Path {
        &self.path
    }
}

fn verified(file: &File, hold: Hold) -> Result<OwnedBank, Error> {
    OwnedBank::of(FileBytes::of(file, hold)?)?.verify()
}
