//! Reading the files of a project for the page. By now, a path may be something else than when it was found.

use crate::shared::input_file;
use lipz_diagnostics::Report;
use lipz_sync::FileFacts;
use std::fs::{self, File};
use std::io;
use std::path::Path;

/// Opens a recording, if it is audio. Its path may be a link to any file of this machine, which must not get into a page.
pub(super) fn open_recording(path: &Path) -> Result<File, Report> {
    let open = || is_file(path).and_then(|()| File::open(path));
    let file = open().map_err(|error| input_file::unreadable(path, &error))?;
    FileFacts::length_us(path)?;
    Ok(file)
}

/// Reads a Lipz file. Fails for a pipe, which would not end.
pub(super) fn read(path: &Path) -> io::Result<Vec<u8>> {
    is_file(path)?;
    input_file::read(path)
}

fn is_file(path: &Path) -> io::Result<()> {
    match fs::metadata(path)?.is_file() {
        true => Ok(()),
        false => Err(io::Error::new(io::ErrorKind::InvalidInput, "it is not a file")),
    }
}
