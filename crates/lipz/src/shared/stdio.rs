//! Standard input and output, where a path is `-`.

use crate::console;
use lipz_compiler::{Content, Input};
use lipz_diagnostics::{Code, Diagnostic, Report};
use std::io::{self, Read};
use std::path::{Component, Path, PathBuf};
use std::sync::OnceLock;

/// The file that standard input is the text of, if the command line says so. There is but one input.
static FILE: OnceLock<PathBuf> = OnceLock::new();

/// What comes from standard input is the text of this file.
pub(crate) fn is_text_of(file: PathBuf) {
    FILE.get_or_init(|| file);
}

/// How messages call what came from standard input.
pub(crate) fn input_name() -> String {
    FILE.get().map_or_else(|| "<stdin>".to_owned(), |file| console::path(file))
}

/// The key of a clip that came from standard input: that of its file, below the root; `stdin` without a file.
pub(crate) fn input_key(root: Option<&Path>) -> String {
    let Some(file) = FILE.get() else { return "stdin".to_owned() };
    let below = root.and_then(|root| file.strip_prefix(root).ok()).unwrap_or(file);
    let parts = below.with_extension("");
    let parts = parts.components().filter_map(|part| match part {
        Component::Normal(name) => Some(name.to_string_lossy()),
        _ => None,
    });
    parts.collect::<Vec<_>>().join("/")
}

/// Whether a path stands for standard input or output. A file of that name is `./-`.
pub(crate) fn is_meant(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// Standard input as a Lipz file, whose key counts from the root.
pub(crate) fn lipz_file(root: Option<&Path>) -> Result<Input, Report> {
    let content = Content::Bytes { name: input_name(), bytes: lipz_bytes()? };
    Ok(Input { key: input_key(root), content })
}

/// The bytes of a Lipz file on standard input.
pub(crate) fn lipz_bytes() -> Result<Vec<u8>, Report> {
    // One byte more than is allowed shows that there are too many.
    read(lipz_file::MAX_FILE_BYTES as u64 + 1).map_err(|error| {
        let message = format!("standard input cannot be read: {error}");
        Report::about(input_name(), Diagnostic::new(Code::UnreadableFile, message))
    })
}

/// Standard input up to its end, or up to `limit_bytes`.
pub(crate) fn read(limit_bytes: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    io::stdin().lock().take(limit_bytes).read_to_end(&mut bytes)?;
    Ok(bytes)
}
