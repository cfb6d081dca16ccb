//! Scripts: the texts of many recordings in one file.

use crate::Abort;
use crate::console;
use crate::reporter::Reporter;
use lipz_diagnostics::{Code, Diagnostic, Report};
use lipz_interop::{Encoding, Script};
use std::fs;
use std::path::Path;

/// Reads the script in a file. Reports its problems.
pub(crate) fn read(path: &Path, encoding: Option<&'static Encoding>, reporter: &mut Reporter) -> Result<Script, Abort> {
    let shown = console::path(path);
    let bytes = fs::read(path).map_err(|error| {
        let diagnostic = Diagnostic::new(Code::UnreadableFile, format!("`{shown}` cannot be read: {error}"));
        let help = "check the spelling of the path, and that you may read it";
        reporter.fail(Report::about(shown.as_str(), diagnostic.help(help)))
    })?;
    let (script, source, diagnostics) = Script::read(&shown, &bytes, encoding);
    let report = Report::new(source, diagnostics);
    let has_errors = report.has_errors();
    let found = if report.diagnostics.is_empty() { Vec::new() } else { vec![report] };
    if has_errors {
        return Err(reporter.refuse(found));
    }
    reporter.add(found);
    Ok(script)
}
