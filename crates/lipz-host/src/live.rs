//! A bank whose file is replaced while the program runs.

use crate::bytes::Backing;
use crate::stamp::{Stamp, checksum};
use crate::{FileBytes, OpenError, OwnedBank};
use std::fs::{self, File};
use std::io::{Seek, SeekFrom};
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
    /// `Map` only where somebody has promised what `open_mapped` asks for.
    backing: Backing,
    current: RwLock<Arc<OwnedBank>>,
    /// What the file looked like when it was used or refused.
    seen: Mutex<Seen>,
}

impl LiveBank {
    /// Reads the bank at `path` into memory and verifies it. New versions are read, too.
    ///
    /// # Errors
    /// When the file cannot be read, is no bank, or a damaged one.
    pub fn open(path: impl Into<PathBuf>) -> Result<LiveBank, OpenError> {
        LiveBank::open_as(path.into(), Backing::Memory)
    }

    /// Maps the bank at `path` and verifies it. New versions are mapped, too.
    ///
    /// # Safety
    /// As for [`FileBytes::map`], for this file and for every file that takes its place: nobody changes or
    /// truncates it as long as a version of this bank exists. New versions are renamed over it.
    ///
    /// # Errors
    /// When the file cannot be mapped, is no bank, or a damaged one.
    #[allow(unsafe_code)] // the caller keeps the contract
    pub unsafe fn open_mapped(path: impl Into<PathBuf>) -> Result<LiveBank, OpenError> {
        LiveBank::open_as(path.into(), Backing::Map)
    }

    fn open_as(path: PathBuf, backing: Backing) -> Result<LiveBank, OpenError> {
        let file = File::open(&path)?;
        let stamp = Stamp::new(&file.metadata()?);
        let current = RwLock::new(Arc::new(verified(&file, backing)?));
        Ok(LiveBank { path, backing, current, seen: Mutex::new(Seen::new(stamp, true)) })
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
    /// or from a thread of your own. Of a file that is younger than two seconds, its header is read with every call: on
    /// some file systems the next one could look the same.
    ///
    /// # Errors
    /// Why the file cannot be used; the old version stays the current one. A damaged file is refused once
    /// more with every call while it is younger than two seconds, for it may still be written, and then not
    /// again until it changes. A missing one is refused every time.
    pub fn refresh(&self) -> Result<bool, OpenError> {
        // Held until the end: one version after the other.
        let mut seen = self.seen.lock().unwrap_or_else(PoisonError::into_inner);
        if seen.stamp == Stamp::new(&fs::metadata(&self.path)?) && seen.is_settled {
            return Ok(false);
        }
        let file = File::open(&self.path)?;
        // Of the very file that is read: the path may lead to the next one by now.
        let stamp = Stamp::new(&file.metadata()?);
        // Before it is read: what is written afterwards then shows.
        let looks_the_same = seen.is_used && seen.stamp == stamp;
        *seen = Seen::new(stamp, false);
        if looks_the_same {
            if checksum(&file)? == Some(self.current().bank().checksum()) {
                seen.is_used = true;
                return Ok(false);
            }
            (&file).seek(SeekFrom::Start(0))?;
        }
        match verified(&file, self.backing) {
            Ok(bank) => {
                *self.current.write().unwrap_or_else(PoisonError::into_inner) = Arc::new(bank);
                seen.is_used = true;
                Ok(true)
            }
            Err(error) => Err(error),
        }
    }

    /// The path of the file.
    pub fn path(&self) -> &Path {
        &self.path
    }
}

/// A look at the file.
#[derive(Debug)]
struct Seen {
    stamp: Stamp,
    /// Whether another file would look otherwise. That of a younger one may be replaced by one that looks the same.
    is_settled: bool,
    /// Whether it is the current version.
    is_used: bool,
}

impl Seen {
    fn new(stamp: Stamp, is_used: bool) -> Seen {
        Seen { stamp, is_settled: stamp.is_settled(), is_used }
    }
}

#[allow(unsafe_code)] // the contract of `LiveBank::open_mapped`, through which alone a bank is mapped
fn verified(file: &File, backing: Backing) -> Result<OwnedBank, OpenError> {
    let bytes = match backing {
        Backing::Memory => FileBytes::read_from(file)?,
        // SAFETY: whoever called `open_mapped` has promised it for the file and its successors.
        Backing::Map => unsafe { FileBytes::map_from(file) }?,
    };
    OwnedBank::from_bytes(bytes)?.verify()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use lipz_compiler::{Compiler, Input};

    fn bank(file: &str) -> Vec<u8> {
        Compiler::default().compile(&[Input::from_bytes("line", file)]).into_bank().unwrap()
    }

    /// The clocks of some file systems tick once a second: a new version within the second looks as the one before.
    #[test]
    fn a_version_that_looks_like_the_one_before_is_taken_in() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("dialogue.lipzbank");
        let (old, new) = (bank(r#"{ "visemes": "MA" }"#), bank(r#"{ "visemes": "AM" }"#));
        fs::write(&path, &old).unwrap();
        let live = LiveBank::open(&path).unwrap();
        assert!(!live.refresh().unwrap(), "young, and the same");
        for bytes in [&new, &old, &new] {
            fs::write(&path, bytes).unwrap();
            live.seen.lock().unwrap().stamp = Stamp::new(&fs::metadata(&path).unwrap());
            assert!(live.refresh().unwrap());
            assert_eq!(**live.current().bytes(), *bytes);
            assert!(!live.refresh().unwrap());
        }
    }
}
