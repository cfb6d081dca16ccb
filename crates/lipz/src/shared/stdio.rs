//! Standard input and output, where a path is `-`.

use crate::Abort;
use crate::console;
use crate::reporter::Reporter;
use lipz_compiler::{Content, Input};
use lipz_diagnostics::{Code, Diagnostic, Report};
use std::io::{self, IsTerminal, Read};
use std::path::{Component, Path, PathBuf};
use std::sync::OnceLock;

/// The file whose text standard input carries, if the command line names it. There is only one input.
static FILE: OnceLock<PathBuf> = OnceLock::new();

/// Sets the file whose text standard input carries.
pub(crate) fn is_text_of(file: PathBuf) {
    FILE.get_or_init(|| file);
}

/// Returns the file whose text standard input carries.
pub(crate) fn name() -> Option<PathBuf> {
    FILE.get().cloned()
}

/// Returns the name of standard input in messages.
pub(crate) fn input_name() -> String {
    FILE.get().map_or_else(|| "<stdin>".to_owned(), |file| console::path(file))
}

/// Returns the key of a clip from standard input: that of its file, relative to the root, or `stdin` without a file.
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

/// Whether a path stands for standard input or output. Use `./-` for a file of that name.
pub(crate) fn is_meant(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// Refuses to print a bank on a terminal.
pub(crate) fn refuse_terminal(reporter: &mut Reporter) -> Result<(), Abort> {
    if io::stdout().is_terminal() {
        let tip = "name a file, or redirect standard output to a file";
        return Err(reporter.usage("a bank cannot be printed on a terminal", tip));
    }
    Ok(())
}

/// Reads standard input as a Lipz file, with a key relative to the root.
pub(crate) fn lipz_file(root: Option<&Path>) -> Result<Input, Report> {
    let content = Content::Bytes { name: input_name(), bytes: lipz_bytes()? };
    Ok(Input { key: input_key(root), content })
}

/// Reads the bytes of a Lipz file from standard input.
pub(crate) fn lipz_bytes() -> Result<Vec<u8>, Report> {
    // One byte more than allowed shows that the input is too long.
    read(lipz_file::MAX_FILE_BYTES as u64 + 1).map_err(|error| {
        let message = format!("standard input cannot be read: {error}");
        Report::about(input_name(), Diagnostic::new(Code::UnreadableFile, message))
    })
}

/// Reads standard input to its end, or up to `limit_bytes`.
pub(crate) fn read(limit_bytes: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    io::stdin().lock().take(limit_bytes).read_to_end(&mut bytes)?;
    Ok(bytes)
}
