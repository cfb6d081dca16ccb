//! Files under a temporary name, until they are whole and on disk and take the place of others.

#[cfg(feature = "unpack")]
mod below;
mod keep;
mod leftovers;
mod sync;

#[cfg(feature = "unpack")]
pub(crate) use below::{FileBelow, OpenFolder};
pub(crate) use leftovers::Leftovers;
pub(crate) use sync::{sync_folders, sync_temporary};

use crate::same::has_all;
use std::ffi::OsStr;
use std::fs::File;
use std::io::{self, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use tempfile::{Builder, NamedTempFile};

/// What temporary names end with: nothing that any command reads, and no other program's.
const SUFFIX: &str = ".lipztmp";

/// A new file, in the folder of the one that it will replace. It is removed if it does not.
#[derive(Debug)]
pub(crate) enum TemporaryFile {
    /// Wherever a path leads.
    Beside { temporary: NamedTempFile, target: PathBuf },
    /// Nowhere but below a folder.
    #[cfg(feature = "unpack")]
    Below(FileBelow),
}

/// A folder in which a file has got its name.
#[derive(Clone, Debug)]
pub(crate) enum Folder {
    Path(PathBuf),
    #[cfg(feature = "unpack")]
    Open(std::sync::Arc<OpenFolder>),
}

impl TemporaryFile {
    /// The file with these bytes, not yet on disk.
    pub(crate) fn beside(path: &Path, bytes: &[u8]) -> io::Result<TemporaryFile> {
        TemporaryFile::beside_with(path, |file| file.write_all(bytes)).map(|(file, ())| file)
    }

    /// The file that `write` fills, not yet on disk, and what that returned.
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
            // Temporary files are private by default; a bank is as public as the umask allows.
            use std::os::unix::fs::PermissionsExt;
            builder.permissions(std::fs::Permissions::from_mode(0o666));
        }
        let mut temporary = builder.tempfile_in(folder)?;
        let written = write(temporary.as_file_mut())?;
        if let Ok(metadata) = target.metadata() {
            // Whoever may write to a folder may replace files in it that they cannot read.
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

    /// Gives it its name, and returns the folder in which that is.
    pub(crate) fn rename(self) -> io::Result<Folder> {
        match self {
            TemporaryFile::Beside { temporary, target } => {
                temporary.persist(&target).map_err(|error| error.error)?;
                Ok(Folder::Path(folder_of(&target).to_owned()))
            }
            #[cfg(feature = "unpack")]
            TemporaryFile::Below(file) => file.rename(),
        }
    }
}

impl Folder {
    fn path(&self) -> &Path {
        match self {
            Folder::Path(path) => path,
            #[cfg(feature = "unpack")]
            Folder::Open(folder) => &folder.path,
        }
    }

    /// Opens it as a file that can be synced.
    fn open(&self) -> io::Result<File> {
        match self {
            Folder::Path(path) => File::open(path),
            #[cfg(feature = "unpack")]
            Folder::Open(folder) => folder.dir.open(".").map(cap_std::fs::File::into_std),
        }
    }
}

/// Leaves each folder once.
pub(crate) fn distinct(mut folders: Vec<Folder>) -> Vec<Folder> {
    folders.sort_unstable_by(|a, b| a.path().cmp(b.path()));
    folders.dedup_by(|a, b| a.path() == b.path());
    folders
}

/// What the temporary name of a file starts with: a dot, so that nobody takes it for a source.
fn prefix(name: &OsStr) -> String {
    format!(".{}.", name.to_string_lossy())
}

/// The folder in which the file at `path` lies.
pub(crate) fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// The file that `path` names, through links; an error if it is something else than a file.
fn target(path: &Path) -> io::Result<PathBuf> {
    match path.metadata() {
        Ok(metadata) if metadata.is_file() => path.canonicalize(),
        Ok(metadata) if metadata.is_dir() => Err(io::Error::other("it is a folder")),
        Ok(_) => Err(io::Error::other("it is a pipe or a device, not a file")),
        Err(_) if path.is_symlink() => Err(io::Error::other("it is a link to a file that does not exist")),
        Err(_) => Ok(path.to_owned()),
    }
}
