//! Temporary files that stay within a folder, even if links in it point elsewhere.

use super::{DestinationFolder, SUFFIX, keep, prefix};
use cap_std::fs::{Dir, OpenOptions};
use std::ffi::OsStr;
use std::fs::File;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tempfile::Builder;

/// An open folder.
#[derive(Debug)]
pub(crate) struct OpenFolder {
    pub(crate) dir: Dir,
    /// Its path, which identifies it.
    pub(crate) path: PathBuf,
}

/// A new file in an open folder. It is removed unless it is renamed.
#[derive(Debug)]
pub(crate) struct FileBelow {
    folder: Arc<OpenFolder>,
    file: File,
    /// The temporary name.
    name: String,
    target: String,
}

impl FileBelow {
    /// Creates the file with these bytes, unsynced, to replace `target` in `folder`.
    pub(crate) fn new(folder: &Arc<OpenFolder>, target: &str, bytes: &[u8]) -> io::Result<FileBelow> {
        let mut options = OpenOptions::new();
        options.write(true).create_new(true);
        let name_of = |path: &Path| path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        // The builder is used only for a free name. Nothing is created at its path.
        let made = Builder::new()
            .prefix(&prefix(OsStr::new(target)))
            .suffix(SUFFIX)
            .disable_cleanup(true)
            .make_in("/", |path| folder.dir.open_with(name_of(path), &options))?;
        let name = name_of(made.path());
        let file = made.into_file().into_std();
        let mut below = FileBelow { folder: Arc::clone(folder), file, name, target: target.to_owned() };
        below.file.write_all(bytes)?;
        // A link is replaced, not followed.
        if folder.dir.symlink_metadata(target).is_ok_and(|metadata| metadata.is_file())
            && let Ok(old) = folder.dir.open(target).map(cap_std::fs::File::into_std)
        {
            keep::keep(&old.metadata()?, Some(&old), &below.file)?;
        }
        Ok(below)
    }

    pub(crate) fn as_file(&self) -> &File {
        &self.file
    }

    /// Renames it to its target, and returns the folder that contains it.
    pub(crate) fn rename(mut self) -> io::Result<DestinationFolder> {
        let dir = &self.folder.dir;
        match dir.rename(&self.name, dir, &self.target) {
            Ok(()) => {
                self.name.clear();
                Ok(DestinationFolder::Open(Arc::clone(&self.folder)))
            }
            Err(_) if dir.symlink_metadata(&self.target).is_ok_and(|metadata| metadata.is_dir()) => {
                Err(io::Error::other("it is a folder"))
            }
            Err(error) => Err(error),
        }
    }
}

impl Drop for FileBelow {
    fn drop(&mut self) {
        if !self.name.is_empty() {
            // It may not exist any longer.
            let _ = self.folder.dir.remove_file(&self.name);
        }
    }
}
