//! Reading the files of a project for the page. By now, a path may be something else than when it was found.

use crate::console;
use lipz_diagnostics::{Code, Report};
use lipz_sync::FileFacts;
use std::fs::{self, File};
use std::io;
use std::path::Path;

/// Opens a recording, if it is audio. Its path may be a link to any file of this machine, which must not get into a page.
pub(super) fn open_recording(path: &Path) -> Result<File, Report> {
    let open = || is_file(path).and_then(|()| File::open(path));
    let file = open().map_err(|error| {
        let message = format!("`{}` cannot be read: {error}", console::path(path));
        Report::failure(console::path(path), Code::UnreadableFile, message, "check that you may read it")
    })?;
    FileFacts::length_us(path)?;
    Ok(file)
}

/// Reads a Lipz file. Fails for a pipe, which would not end.
pub(super) fn read(path: &Path) -> io::Result<Vec<u8>> {
    is_file(path)?;
    fs::read(path)
}

fn is_file(path: &Path) -> io::Result<()> {
    match fs::metadata(path)?.is_file() {
        true => Ok(()),
        false => Err(io::Error::new(io::ErrorKind::InvalidInput, "it is not a file")),
    }
}
