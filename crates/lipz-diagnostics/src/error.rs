//! Diagnostics as an error: why a function has no result.

use crate::{Report, Severity, reports};
use std::fmt;

/// Diagnostics about one or more files, including at least one error. `Display` and `Debug` list all of them, so that a
/// `main` that returns the error prints them.
///
/// ```
/// use lipz_diagnostics::{Code, Diagnostic, DiagnosticsError, Report};
/// let missing = Report::about("voices", Diagnostic::new(Code::UnreadableFile, "`voices` does not exist"));
/// let error = DiagnosticsError::check("the files", vec![missing]).unwrap_err();
/// assert_eq!(error.to_string(), "1 error\nvoices: error[LZ0001]: `voices` does not exist");
/// ```
#[derive(Clone, PartialEq, Eq)]
pub struct DiagnosticsError {
    reports: Vec<Report>,
}

impl DiagnosticsError {
    /// Returns the value and the reports, which then contain only warnings.
    ///
    /// # Errors
    /// If a report has an error. The error also contains the warnings.
    pub fn check<T>(value: T, reports: Vec<Report>) -> Result<(T, Vec<Report>), DiagnosticsError> {
        if reports::have_errors(&reports) { Err(DiagnosticsError { reports }) } else { Ok((value, reports)) }
    }

    /// Returns the diagnostics, file by file.
    pub fn reports(&self) -> &[Report] {
        &self.reports
    }

    /// Returns the diagnostics without a copy.
    pub fn into_reports(self) -> Vec<Report> {
        self.reports
    }
}

impl From<Report> for DiagnosticsError {
    fn from(report: Report) -> DiagnosticsError {
        DiagnosticsError { reports: vec![report] }
    }
}

impl fmt::Display for DiagnosticsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match reports::count(&self.reports, Severity::Error) {
            1 => f.write_str("1 error")?,
            errors => write!(f, "{errors} errors")?,
        }
        for report in &self.reports {
            write!(f, "\n{}", report.to_string().trim_end())?;
        }
        Ok(())
    }
}

/// Prints the same text, because a `main` that returns the error prints it this way.
impl fmt::Debug for DiagnosticsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl std::error::Error for DiagnosticsError {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Code, Diagnostic};

    #[test]
    fn only_errors_withhold_the_value() {
        let about = |path: &str, code| Report::about(path, Diagnostic::new(code, "found"));
        let warning = about("a", Code::ByteOrderMark);
        assert_eq!(DiagnosticsError::check(1, vec![]), Ok((1, vec![])));
        assert_eq!(DiagnosticsError::check(1, vec![warning.clone()]), Ok((1, vec![warning.clone()])));
        let error = DiagnosticsError::check(1, vec![warning.clone(), about("b", Code::EmptyFile)]).unwrap_err();
        assert_eq!(error.to_string(), "1 error\na: warning[LZ0005]: found\nb: error[LZ0002]: found");
        assert_eq!(format!("{error:?}"), error.to_string());
        assert_eq!(error.reports().len(), 2);
        assert_eq!(error.into_reports()[0], warning);
    }
}
