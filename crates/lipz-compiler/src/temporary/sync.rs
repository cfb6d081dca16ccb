//! Bringing many files to disk at once.

use super::{Folder, TemporaryFile};
use std::fs::File;
use std::io;

/// From so many files on, syncing the whole file system is faster than syncing one after the other, each of which
/// waits for its journal.
#[cfg(target_os = "linux")]
const MANY: usize = 8;

/// Brings temporary files to disk.
pub(crate) fn sync_temporary<'t>(files: impl ExactSizeIterator<Item = &'t TemporaryFile>) -> io::Result<()> {
    sync_files(files.map(TemporaryFile::as_file))
}

/// Makes renames in these folders last. Some file systems cannot: the files are there all the same.
pub(crate) fn sync_folders(folders: &[Folder]) {
    if cfg!(unix) {
        let open: Vec<File> = folders.iter().filter_map(|folder| folder.open().ok()).collect();
        let _ = sync_files(open.iter());
    }
}

#[cfg(target_os = "linux")]
fn sync_files<'f>(files: impl ExactSizeIterator<Item = &'f File>) -> io::Result<()> {
    use std::os::unix::fs::MetadataExt;
    if files.len() < MANY {
        return each_synced(files);
    }
    // Usually they are on one.
    let mut file_systems = Vec::new();
    for file in files {
        let device = file.metadata()?.dev();
        if !file_systems.contains(&device) {
            rustix::fs::syncfs(file)?;
            file_systems.push(device);
        }
    }
    Ok(())
}

#[cfg(not(target_os = "linux"))]
fn sync_files<'f>(files: impl ExactSizeIterator<Item = &'f File>) -> io::Result<()> {
    each_synced(files)
}

fn each_synced<'f>(mut files: impl Iterator<Item = &'f File>) -> io::Result<()> {
    files.try_for_each(File::sync_all)
}
