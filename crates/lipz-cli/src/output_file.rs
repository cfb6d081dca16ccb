//! Files that commands write: whole, or not at all.

use crate::render::Findings;
use crate::{Outcome, interrupt};
use lipz_compiler::replace_file;
use std::path::Path;

/// Replaces the file at `path`, also when the run is interrupted meanwhile. Reports why that is not possible.
pub(crate) fn write(path: &Path, bytes: &[u8], findings: &mut Findings) -> Result<(), Outcome> {
    interrupt::whole(|| replace_file(path, bytes)).map_err(|report| findings.fail(report))
}
