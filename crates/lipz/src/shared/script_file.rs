//! Scripts: the texts of many recordings in one file.

use crate::Abort;
use crate::console;
use crate::reporter::Reporter;
use crate::shared::input_file::{self, unreadable};
use lipz_diagnostics::Report;
use lipz_interop::{Encoding, Script};
use std::path::Path;

/// Reads the script in a file. Reports its problems.
pub(crate) fn read(path: &Path, encoding: Option<&'static Encoding>, reporter: &mut Reporter) -> Result<Script, Abort> {
    let bytes = input_file::read(path).map_err(|error| reporter.fail(unreadable(path, &error)))?;
    let (script, source, diagnostics) = Script::read(&console::path(path), &bytes, encoding);
    let report = Report::new(source, diagnostics);
    let has_errors = report.has_errors();
    let found = if report.diagnostics.is_empty() { Vec::new() } else { vec![report] };
    if has_errors {
        return Err(reporter.refuse(found));
    }
    reporter.add(found);
    Ok(script)
}
