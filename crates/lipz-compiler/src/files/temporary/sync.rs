//! Syncing many files at once.

use super::{DestinationFolder, TemporaryFile};
use std::fs::File;
use std::io;

/// The number of files from which on syncing the whole file system is faster than syncing them one by one, each of
/// which waits for the journal.
#[cfg(target_os = "linux")]
const MANY: usize = 8;

/// Syncs temporary files to disk.
pub(crate) fn sync_temporary<'t>(files: impl ExactSizeIterator<Item = &'t TemporaryFile>) -> io::Result<()> {
    sync_files(files.map(TemporaryFile::as_file))
}

/// Makes renames in these folders permanent. Ignores file systems that do not support this.
pub(crate) fn sync_folders(folders: &[DestinationFolder]) {
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
    // Usually there is only one.
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
