//! Diagnostics as an error: the reason why a function has no result.

use crate::{Report, Severity, reports};
use std::fmt;

/// Diagnostics about one or more files, at least one of which is an error. `Display` and `Debug` list all of them, so that a
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
    /// The value and the reports, which are warnings then.
    ///
    /// # Errors
    /// If a report has an error. It takes the warnings with it.
    pub fn check<T>(value: T, reports: Vec<Report>) -> Result<(T, Vec<Report>), DiagnosticsError> {
        if reports::have_errors(&reports) { Err(DiagnosticsError { reports }) } else { Ok((value, reports)) }
    }

    /// The diagnostics, file by file.
    pub fn reports(&self) -> &[Report] {
        &self.reports
    }

    /// The same without a copy.
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

/// The same text: a `main` that returns the error prints it.
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
