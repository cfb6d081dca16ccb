//! Files that commands write: whole, or not at all, and never over sources.

use crate::Abort;
use crate::reporter::Reporter;
use crate::{console, interrupt};
use lipz_compiler::{key, replace_file};
use std::path::Path;

/// Refuses an output with the name of a Lipz file: a slip of the hand would replace a clip by a bank.
pub(crate) fn refuse_source(path: &Path, reporter: &mut Reporter) -> Result<(), Abort> {
    if path.extension().is_none_or(|extension| !extension.eq_ignore_ascii_case(key::EXTENSION)) {
        return Ok(());
    }
    let message = format!("`{}` is the name of a Lipz file, not of an output", console::path(path));
    Err(reporter.usage(message, "give the output another extension"))
}

/// Replaces the file at `path`, also when the run is interrupted meanwhile. Reports why that is not possible.
pub(crate) fn write(path: &Path, bytes: &[u8], reporter: &mut Reporter) -> Result<(), Abort> {
    interrupt::whole(|| replace_file(path, bytes)).map_err(|report| reporter.fail(report))
}
