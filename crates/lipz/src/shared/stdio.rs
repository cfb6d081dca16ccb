//! Standard input and output, where a path is `-`.

use lipz_compiler::{Content, Input};
use lipz_diagnostics::{Code, Diagnostic, Report};
use std::io::{self, Read};
use std::path::Path;

/// How messages call what came from standard input.
pub(crate) const INPUT_NAME: &str = "<stdin>";
/// The key of a clip that came from standard input: it has no path.
pub(crate) const INPUT_KEY: &str = "stdin";

/// Whether a path stands for standard input or output. A file of that name is `./-`.
pub(crate) fn is_meant(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// Standard input as a Lipz file.
pub(crate) fn lipz_file() -> Result<Input, Report> {
    let content = Content::Bytes { name: INPUT_NAME.into(), bytes: lipz_bytes()? };
    Ok(Input { key: INPUT_KEY.into(), content })
}

/// The bytes of a Lipz file on standard input.
pub(crate) fn lipz_bytes() -> Result<Vec<u8>, Report> {
    // One byte more than is allowed shows that there are too many.
    read(lipz_file::MAX_FILE_BYTES as u64 + 1).map_err(|error| {
        let message = format!("standard input cannot be read: {error}");
        Report::about(INPUT_NAME, Diagnostic::new(Code::UnreadableFile, message))
    })
}

/// Standard input up to its end, or up to `limit_bytes`.
pub(crate) fn read(limit_bytes: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    io::stdin().lock().take(limit_bytes).read_to_end(&mut bytes)?;
    Ok(bytes)
}
