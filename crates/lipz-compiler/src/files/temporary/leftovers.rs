//! Abandoned temporary files.

use super::{DestinationFolder, SUFFIX};
use std::collections::HashSet;
use std::ffi::OsStr;
use std::path::PathBuf;
use std::time::{Duration, SystemTime};
use std::{fs, io};

/// The age from which a temporary file belongs to a killed run. Others exist only for seconds.
const FORSAKEN_AFTER: Duration = Duration::from_secs(60 * 60);

/// Removes files that killed runs have left in the folders being written.
#[derive(Debug, Default)]
pub(crate) struct Leftovers {
    /// Folders that have already been searched.
    seen: HashSet<PathBuf>,
}

impl Leftovers {
    /// Removes leftover files in these folders. Files that cannot be removed are harmless and stay.
    pub(crate) fn remove(&mut self, folders: &[DestinationFolder]) {
        let now = SystemTime::now();
        for folder in folders {
            if self.seen.insert(folder.path().to_owned()) {
                // It can be removed by a later run.
                let _ = remove_from(folder, now);
            }
        }
    }
}

fn remove_from(folder: &DestinationFolder, now: SystemTime) -> io::Result<()> {
    match folder {
        DestinationFolder::Path(path) => {
            for entry in fs::read_dir(path)?.flatten().filter(|entry| is_temporary(&entry.file_name())) {
                let metadata = entry.metadata()?;
                if metadata.is_file() && is_forsaken(metadata.modified()?, now) {
                    fs::remove_file(entry.path())?;
                }
            }
        }
        #[cfg(feature = "unpack")]
        DestinationFolder::Open(folder) => {
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

/// Whether a name is that of one of our temporary files.
fn is_temporary(name: &OsStr) -> bool {
    let name = name.as_encoded_bytes();
    name.starts_with(b".") && name.ends_with(SUFFIX.as_bytes())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::replace_file;
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
