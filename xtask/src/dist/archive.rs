//! Archives in memory. Times and order are fixed, so that equal contents are equal bytes.

use flate2::Compression;
use flate2::write::GzEncoder;
use sha2::{Digest, Sha256};
use std::fs;
use std::io::{self, Cursor, Write};
use std::path::Path;
use zip::write::SimpleFileOptions;

/// 26 October 1985, 8:15, the time of files in npm packages. In years before 1980, zip files have none.
const TIME_S: u64 = 499_162_500;

/// A file of a package.
#[derive(Clone)]
pub(crate) struct Entry {
    /// With `/` between folders.
    pub(crate) path: String,
    pub(crate) content: Content,
}

/// The content of an [`Entry`].
#[derive(Clone)]
pub(crate) enum Content {
    File(Vec<u8>),
    /// A file that users may execute.
    Program(Vec<u8>),
    /// A symbolic link to a path, relative to the folder of the entry.
    Link(String),
}

impl Entry {
    pub(crate) fn file(path: impl Into<String>, bytes: impl Into<Vec<u8>>) -> Entry {
        Entry { path: path.into(), content: Content::File(bytes.into()) }
    }

    pub(crate) fn program(path: impl Into<String>, bytes: impl Into<Vec<u8>>) -> Entry {
        Entry { path: path.into(), content: Content::Program(bytes.into()) }
    }

    /// Writes the entry below a folder of this machine, and replaces an existing one. Without symbolic links, a link
    /// becomes a copy, so its file must exist.
    pub(crate) fn write(&self, folder: &Path) -> io::Result<()> {
        let path = folder.join(&self.path);
        if let Some(parent) = path.parent() {
            fs::create_dir_all(parent)?;
        }
        // Otherwise the file of an existing link would be replaced.
        if path.symlink_metadata().is_ok() {
            fs::remove_file(&path)?;
        }
        match &self.content {
            Content::File(bytes) => fs::write(&path, bytes),
            Content::Program(bytes) => fs::write(&path, bytes).and_then(|()| make_executable(&path)),
            Content::Link(target) => link(target, &path),
        }
    }

    /// Returns the entry in a folder.
    pub(super) fn below(&self, folder: &str) -> Entry {
        Entry { path: format!("{folder}/{}", self.path), content: self.content.clone() }
    }
}

#[cfg(unix)]
fn make_executable(path: &Path) -> io::Result<()> {
    use std::os::unix::fs::PermissionsExt;
    fs::set_permissions(path, fs::Permissions::from_mode(0o755))
}

#[cfg(not(unix))]
fn make_executable(_: &Path) -> io::Result<()> {
    Ok(())
}

#[cfg(unix)]
fn link(target: &str, path: &Path) -> io::Result<()> {
    std::os::unix::fs::symlink(target, path)
}

#[cfg(not(unix))]
fn link(target: &str, path: &Path) -> io::Result<()> {
    fs::copy(path.with_file_name(target), path).map(|_| ())
}

/// Returns a `.tar.gz` archive.
pub(super) fn tar_gz(entries: &[Entry]) -> io::Result<Vec<u8>> {
    let mut archive = tar::Builder::new(GzEncoder::new(Vec::new(), Compression::best()));
    for Entry { path, content } in entries {
        let mut header = tar::Header::new_gnu();
        header.set_mtime(TIME_S);
        match content {
            Content::File(bytes) | Content::Program(bytes) => {
                header.set_mode(if matches!(content, Content::File(_)) { 0o644 } else { 0o755 });
                header.set_size(bytes.len() as u64);
                archive.append_data(&mut header, path, bytes.as_slice())?;
            }
            Content::Link(target) => {
                header.set_entry_type(tar::EntryType::Symlink);
                header.set_mode(0o777);
                header.set_size(0);
                archive.append_link(&mut header, path, target)?;
            }
        }
    }
    archive.into_inner()?.finish()
}

/// Returns a `.zip` archive, the format of wheels.
pub(super) fn zip(entries: &[Entry]) -> io::Result<Vec<u8>> {
    let mut archive = zip::ZipWriter::new(Cursor::new(Vec::new()));
    let time = zip::DateTime::from_date_and_time(1985, 10, 26, 8, 15, 0).map_err(io::Error::other)?;
    let options = SimpleFileOptions::default().compression_level(Some(9)).last_modified_time(time);
    for Entry { path, content } in entries {
        match content {
            Content::File(bytes) | Content::Program(bytes) => {
                // pip makes a script executable only if its entry has such a mode.
                let mode = if matches!(content, Content::File(_)) { 0o644 } else { 0o755 };
                archive.start_file(path, options.unix_permissions(mode))?;
                archive.write_all(bytes)?;
            }
            Content::Link(target) => archive.add_symlink(path, target, options)?,
        }
    }
    Ok(archive.finish()?.into_inner())
}

/// Returns the SHA-256 checksum.
pub(super) fn sha256(bytes: &[u8]) -> [u8; 32] {
    Sha256::digest(bytes).into()
}

/// Returns the line of `sha256sum` for a file.
pub(super) fn checksum_line(name: &str, bytes: &[u8]) -> String {
    let digits: String = sha256(bytes).iter().map(|byte| format!("{byte:02x}")).collect();
    format!("{digits}  {name}\n")
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use std::io::Read;

    fn entries() -> Vec<Entry> {
        let link = Entry { path: "a/link".into(), content: Content::Link("program".into()) };
        vec![Entry::file("a/file", "text"), Entry::program("a/program", "code"), link]
    }

    #[test]
    fn a_tar_archive_has_modes_and_links() {
        let bytes = tar_gz(&entries()).unwrap();
        assert_eq!(bytes, tar_gz(&entries()).unwrap());
        let mut archive = tar::Archive::new(flate2::read::GzDecoder::new(bytes.as_slice()));
        let found: Vec<_> = archive.entries().unwrap().map(Result::unwrap).collect();
        let modes: Vec<u32> = found.iter().map(|entry| entry.header().mode().unwrap()).collect();
        assert_eq!(modes, [0o644, 0o755, 0o777]);
        assert_eq!(found[2].link_name().unwrap().unwrap().to_str(), Some("program"));
    }

    #[test]
    fn a_zip_archive_has_modes_of_regular_files() {
        let mut archive = zip::ZipArchive::new(Cursor::new(zip(&entries()).unwrap())).unwrap();
        // With the type of a regular file, without which pip drops the permission to execute.
        let modes: Vec<_> = (0..2).map(|number| archive.by_index(number).unwrap().unix_mode()).collect();
        assert_eq!(modes, [Some(0o100_644), Some(0o100_755)]);
        let mut text = String::new();
        archive.by_name("a/file").unwrap().read_to_string(&mut text).unwrap();
        assert_eq!(text, "text");
    }

    #[test]
    fn a_checksum_is_that_of_sha256sum() {
        let line = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad  a.zip\n";
        assert_eq!(checksum_line("a.zip", b"abc"), line);
    }
}
