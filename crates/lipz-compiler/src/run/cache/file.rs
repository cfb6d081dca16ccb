//! The file that a user names as cache: read, and replaced only if it is one.

use super::stamps::{CHECK_MAGIC, MAGIC, Magic, Stamps};
use crate::files::path::display;
use crate::files::replace_file;
use lipz_diagnostics::{Code, Report, escape};
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// Returns the stamps in the cache at `path`; `None` if it is missing, damaged or of a different version.
///
/// # Errors
/// If `path` is a file of a different kind, which must not be replaced.
pub(super) fn read(path: &Path, magic: Magic) -> Result<Option<Stamps>, Report> {
    Ok(Stamps::decode(magic, &bytes(path, magic)?))
}

/// Replaces the cache at `path`.
///
/// # Errors
/// If it cannot be written, or if `path` is a file of a different kind.
pub(super) fn write(path: &Path, magic: Magic, stamps: &Stamps) -> Result<(), Report> {
    bytes(path, magic)?;
    match stamps.encode(magic) {
        Some(bytes) => replace_file(path, &bytes),
        None => Ok(()),
    }
}

/// Returns the bytes of the cache at `path`; empty if the cache does not exist.
fn bytes(path: &Path, magic: Magic) -> Result<Vec<u8>, Report> {
    let mut bytes = Vec::new();
    let is_cache = match path.metadata() {
        Ok(metadata) if !metadata.is_file() => Ok(false),
        Ok(_) => File::open(path).and_then(|mut file| {
            file.by_ref().take(magic.len() as u64).read_to_end(&mut bytes)?;
            let is_cache = bytes.is_empty() || bytes == magic;
            if is_cache {
                file.read_to_end(&mut bytes)?;
            }
            Ok(is_cache)
        }),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(true),
        Err(error) => Err(error),
    };
    let why = match is_cache {
        Ok(true) => return Ok(bytes),
        Ok(false) if bytes == MAGIC => "is the cache of a bank and is not overwritten".to_owned(),
        Ok(false) if bytes == CHECK_MAGIC => "is a cache of `lipz check` and is not overwritten".to_owned(),
        Ok(false) => "is not a lipz cache and is not overwritten".to_owned(),
        Err(error) => format!("cannot be read: {error}"),
    };
    let name = display(path);
    let message = format!("{} {why}", escape::quoted(&name));
    Err(Report::failure(name, Code::OutputFailed, message, "name a different file for the cache, or delete this one"))
}
