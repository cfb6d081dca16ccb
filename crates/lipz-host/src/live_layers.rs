//! A stack whose files are replaced while the program runs.

use crate::stamp::{Stamp, checksum};
use crate::{LayersOpenError, OwnedLayers};
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError, RwLock};

/// A bank and the layers over it, which follow their files: [`refresh`](LiveLayers::refresh) takes in new versions once all
/// of them are verified and fit, and keeps the old stack until then.
///
/// Any thread may refresh, any number may read, as with a [`LiveBank`](crate::LiveBank).
#[derive(Debug)]
pub struct LiveLayers {
    paths: Vec<PathBuf>,
    texts: Vec<PathBuf>,
    current: RwLock<Arc<OwnedLayers>>,
    /// What the files looked like when they were used or refused.
    seen: Mutex<Seen>,
}

/// A look at the files.
#[derive(Debug)]
struct Seen {
    stamps: Vec<Stamp>,
    /// Whether other files would look otherwise. Younger ones may be replaced by some that look the same.
    are_settled: bool,
}

impl Seen {
    fn new(stamps: Vec<Stamp>) -> Seen {
        let are_settled = stamps.iter().all(Stamp::is_settled);
        Seen { stamps, are_settled }
    }
}

impl LiveLayers {
    /// Reads the banks at `paths` into memory, the base first, and verifies them.
    ///
    /// # Errors
    /// As [`OwnedLayers::open`].
    pub fn open<P: Into<PathBuf>>(paths: impl IntoIterator<Item = P>) -> Result<LiveLayers, LayersOpenError> {
        LiveLayers::open_with_texts(paths, std::iter::empty())
    }

    /// The same, with the text banks at `texts`, which are followed, too.
    ///
    /// # Errors
    /// As [`OwnedLayers::open_with_texts`].
    pub fn open_with_texts<P: Into<PathBuf>>(
        paths: impl IntoIterator<Item = P>,
        texts: impl IntoIterator<Item = P>,
    ) -> Result<LiveLayers, LayersOpenError> {
        let (paths, texts): (Vec<PathBuf>, Vec<PathBuf>) =
            (paths.into_iter().map(Into::into).collect(), texts.into_iter().map(Into::into).collect());
        // Before they are read: what is written afterwards then shows.
        let seen = Seen::new(stamps(paths.iter().chain(&texts))?);
        let current = RwLock::new(Arc::new(OwnedLayers::open_with_texts(&paths, &texts)?));
        Ok(LiveLayers { paths, texts, current, seen: Mutex::new(seen) })
    }

    /// The current version. Keep it for as long as what you do with it should not change: a conversation, a frame.
    pub fn current(&self) -> Arc<OwnedLayers> {
        Arc::clone(&self.current.read().unwrap_or_else(PoisonError::into_inner))
    }

    /// Looks whether files were replaced, and takes in the new versions: whether there are any.
    ///
    /// As long as the files look the same, this costs a `stat` for each. Of files younger than two seconds, the headers are
    /// read with every call: on some file systems the next ones could look the same.
    ///
    /// # Errors
    /// Why the files cannot be used, such as a patch that was made over another version of its base: replace the other
    /// file, too. The old stack stays the current one. The same files are not refused again once they are older than two
    /// seconds; a missing one is refused every time.
    pub fn refresh(&self) -> Result<bool, LayersOpenError> {
        // Held until the end: one version after the other.
        let mut seen = self.seen.lock().unwrap_or_else(PoisonError::into_inner);
        let now = stamps(self.paths.iter().chain(&self.texts))?;
        if seen.stamps == now && seen.are_settled {
            return Ok(false);
        }
        *seen = Seen::new(now);
        if self.are_used()? {
            return Ok(false);
        }
        let opened = OwnedLayers::open_with_texts(&self.paths, &self.texts)?;
        *self.current.write().unwrap_or_else(PoisonError::into_inner) = Arc::new(opened);
        Ok(true)
    }

    /// The paths of the banks, the base first.
    pub fn paths(&self) -> impl Iterator<Item = &Path> {
        self.paths.iter().map(PathBuf::as_path)
    }

    /// Whether the files have the checksums of the current version.
    fn are_used(&self) -> Result<bool, LayersOpenError> {
        let current = self.current();
        let banks = (0..self.paths.len()).map(|layer| current.layers().bank(layer).map(lipz_bank::Bank::checksum));
        let used = banks.chain(current.text_checksums().iter().copied().map(Some));
        for (path, used) in self.paths.iter().chain(&self.texts).zip(used) {
            let found =
                File::open(path).and_then(checksum).map_err(|error| LayersOpenError::new(path, error.into()))?;
            if found != used {
                return Ok(false);
            }
        }
        Ok(true)
    }
}

/// What the files look like.
fn stamps<'p>(paths: impl Iterator<Item = &'p PathBuf>) -> Result<Vec<Stamp>, LayersOpenError> {
    let stamp = |path: &PathBuf| match fs::metadata(path) {
        Ok(metadata) => Ok(Stamp::new(&metadata)),
        Err(error) => Err(LayersOpenError::new(path, error.into())),
    };
    paths.map(stamp).collect()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::incompatible_msrv)]

    use super::*;
    use lipz_compiler::{Compiler, Input};
    use std::time::{Duration, SystemTime};

    /// A file that was young when it was looked at may have been replaced since by one that looks the same.
    #[test]
    fn a_version_that_looks_like_the_one_before_is_taken_in() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("dialogue.lipzbank");
        let write = |file: &str| {
            let bank = Compiler::default().compile(&[Input::from_bytes("line", file)]).into_bank().unwrap();
            fs::write(&path, bank).unwrap();
        };
        write(r#"{ "visemes": "MA" }"#);
        let live = LiveLayers::open([&path]).unwrap();
        write(r#"{ "visemes": "AM" }"#);
        let long_ago = SystemTime::now() - Duration::from_secs(60);
        File::options().write(true).open(&path).unwrap().set_modified(long_ago).unwrap();
        live.seen.lock().unwrap().stamps = stamps(live.paths.iter()).unwrap();
        assert!(live.refresh().unwrap() && !live.refresh().unwrap());
    }
}
