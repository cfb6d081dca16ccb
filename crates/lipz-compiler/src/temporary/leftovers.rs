//! Temporary files that nobody will come back for.

use super::{Folder, SUFFIX};
use std::collections::HashSet;
use std::ffi::OsStr;
use std::path::PathBuf;
use std::time::{Duration, SystemTime};
use std::{fs, io};

/// A temporary file as old as this is that of a run that was killed: the others live for seconds.
const FORSAKEN_AFTER: Duration = Duration::from_secs(60 * 60);

/// Removes what killed runs have left in the folders in which we write.
#[derive(Debug, Default)]
pub(crate) struct Leftovers {
    /// Folders that were looked at: once is enough.
    seen: HashSet<PathBuf>,
}

impl Leftovers {
    /// Removes what is left in these folders. What cannot be removed stays: it is in nobody's way.
    pub(crate) fn remove(&mut self, folders: &[Folder]) {
        let now = SystemTime::now();
        for folder in folders {
            if self.seen.insert(folder.path().to_owned()) {
                // It can be removed next time.
                let _ = remove_from(folder, now);
            }
        }
    }
}

fn remove_from(folder: &Folder, now: SystemTime) -> io::Result<()> {
    match folder {
        Folder::Path(path) => {
            for entry in fs::read_dir(path)?.flatten().filter(|entry| is_temporary(&entry.file_name())) {
                let metadata = entry.metadata()?;
                if metadata.is_file() && is_forsaken(metadata.modified()?, now) {
                    fs::remove_file(entry.path())?;
                }
            }
        }
        #[cfg(feature = "unpack")]
        Folder::Open(folder) => {
            for entry in folder.dir.entries()?.flatten().filter(|entry| is_temporary(&entry.file_name())) {
                let metadata = entry.metadata()?;
                if metadata.is_file() && is_forsaken(metadata.modified()?.into_std(), now) {
                    entry.remove_file()?;
                }
            }
        }
    }
    Ok(())
}

fn is_forsaken(modified: SystemTime, now: SystemTime) -> bool {
    now.duration_since(modified).is_ok_and(|age| age > FORSAKEN_AFTER)
}

/// Whether a name is one that we give to temporary files.
fn is_temporary(name: &OsStr) -> bool {
    let name = name.as_encoded_bytes();
    name.starts_with(b".") && name.ends_with(SUFFIX.as_bytes())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::replace_file;
    use std::fs::File;

    #[test]
    fn what_a_killed_run_left_goes_when_it_is_old() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        let (old, young, foreign) = (".a.lipz.x1.lipztmp", ".b.lipz.x2.lipztmp", ".c.lipz.x3.tmp");
        for name in [old, young, foreign, "visible.lipztmp"] {
            fs::write(path(name), "").unwrap();
        }
        let long_ago = SystemTime::now() - FORSAKEN_AFTER - Duration::from_secs(1);
        for name in [old, foreign, "visible.lipztmp"] {
            File::options().append(true).open(path(name)).unwrap().set_modified(long_ago).unwrap();
        }
        replace_file(&path("a.lipzbank"), b"new").unwrap();
        assert!(!path(old).exists(), "nobody comes back for it");
        assert!([young, foreign, "visible.lipztmp", "a.lipzbank"].iter().all(|name| path(name).exists()));
    }
}
