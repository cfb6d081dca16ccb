//! Files under temporary names, until they are complete, synced, and renamed to their targets.

#[cfg(feature = "unpack")]
mod below;
mod keep;
mod leftovers;
mod sync;

#[cfg(feature = "unpack")]
pub(crate) use below::{FileBelow, OpenFolder};
pub(crate) use leftovers::Leftovers;
pub(crate) use sync::{sync_folders, sync_temporary};

use crate::files::file_eq::has_all;
use std::ffi::OsStr;
use std::fs::File;
use std::io::{self, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use tempfile::{Builder, NamedTempFile};

/// The suffix of temporary names, which no command and no other program reads.
const SUFFIX: &str = ".lipztmp";

/// A new file, in the folder of its target. It is removed unless it is renamed.
#[derive(Debug)]
pub(crate) enum TemporaryFile {
    /// For the target of any path.
    Beside { temporary: NamedTempFile, target: PathBuf },
    /// Only below a folder.
    #[cfg(feature = "unpack")]
    Below(FileBelow),
}

/// The folder of a renamed file.
#[derive(Clone, Debug)]
pub(crate) enum DestinationFolder {
    Path(PathBuf),
    #[cfg(feature = "unpack")]
    Open(std::sync::Arc<OpenFolder>),
}

impl TemporaryFile {
    /// Creates the file with these bytes, unsynced.
    pub(crate) fn beside(path: &Path, bytes: &[u8]) -> io::Result<TemporaryFile> {
        TemporaryFile::beside_with(path, |file| file.write_all(bytes)).map(|(file, ())| file)
    }

    /// Creates the file with the content from `write`, unsynced, and returns it with the result of `write`.
    pub(crate) fn beside_with<W, E: From<io::Error>>(
        path: &Path,
        write: impl FnOnce(&mut File) -> Result<W, E>,
    ) -> Result<(TemporaryFile, W), E> {
        let target = target(path)?;
        let folder = folder_of(&target);
        std::fs::create_dir_all(folder)?;
        let prefix = prefix(target.file_name().unwrap_or_default());
        let mut builder = Builder::new();
        builder.prefix(&prefix).suffix(SUFFIX);
        #[cfg(unix)]
        {
            // Temporary files are private by default. A bank gets the permissions that the umask allows.
            use std::os::unix::fs::PermissionsExt;
            builder.permissions(std::fs::Permissions::from_mode(0o666));
        }
        let mut temporary = builder.tempfile_in(folder)?;
        let written = write(temporary.as_file_mut())?;
        if let Ok(metadata) = target.metadata() {
            // A user with write access to a folder may replace files in it without permission to read them.
            keep::keep(&metadata, File::open(&target).ok().as_ref(), temporary.as_file())?;
        }
        Ok((TemporaryFile::Beside { temporary, target }, written))
    }

    /// Whether the file at `path` has the same bytes.
    pub(crate) fn has_contents_of(&self, path: &Path) -> bool {
        let mut file = self.as_file();
        let length = file.metadata().map(|metadata| metadata.len());
        length.is_ok_and(|length| file.seek(SeekFrom::Start(0)).is_ok() && has_all(path, length, file))
    }

    fn as_file(&self) -> &File {
        match self {
            TemporaryFile::Beside { temporary, .. } => temporary.as_file(),
            #[cfg(feature = "unpack")]
            TemporaryFile::Below(file) => file.as_file(),
        }
    }

    /// Renames it to its target, and returns the folder that contains it.
    pub(crate) fn rename(self) -> io::Result<DestinationFolder> {
        match self {
            TemporaryFile::Beside { temporary, target } => {
                temporary.persist(&target).map_err(|error| error.error)?;
                Ok(DestinationFolder::Path(folder_of(&target).to_owned()))
            }
            #[cfg(feature = "unpack")]
            TemporaryFile::Below(file) => file.rename(),
        }
    }
}

impl DestinationFolder {
    fn path(&self) -> &Path {
        match self {
            DestinationFolder::Path(path) => path,
            #[cfg(feature = "unpack")]
            DestinationFolder::Open(folder) => &folder.path,
        }
    }

    /// Opens it for syncing.
    fn open(&self) -> io::Result<File> {
        match self {
            DestinationFolder::Path(path) => File::open(path),
            #[cfg(feature = "unpack")]
            DestinationFolder::Open(folder) => folder.dir.open(".").map(cap_std::fs::File::into_std),
        }
    }
}

/// Removes duplicate folders.
pub(crate) fn distinct(mut folders: Vec<DestinationFolder>) -> Vec<DestinationFolder> {
    folders.sort_unstable_by(|a, b| a.path().cmp(b.path()));
    folders.dedup_by(|a, b| a.path() == b.path());
    folders
}

/// Returns the prefix of a file's temporary name, with a dot so that it does not look like a source.
fn prefix(name: &OsStr) -> String {
    format!(".{}.", name.to_string_lossy())
}

/// Returns the folder that contains the file at `path`.
pub(crate) fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// Returns the file to which `path` leads, through links; an error if it is not a file.
fn target(path: &Path) -> io::Result<PathBuf> {
    match path.metadata() {
        Ok(metadata) if metadata.is_file() => path.canonicalize(),
        Ok(metadata) if metadata.is_dir() => Err(io::Error::other("it is a folder")),
        Ok(_) => Err(io::Error::other("it is a pipe or a device, not a file")),
        Err(_) if path.is_symlink() => Err(io::Error::other("it is a link to a file that does not exist")),
        Err(_) => Ok(path.to_owned()),
    }
}
