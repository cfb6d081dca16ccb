//! The result of a run: a bank, or the reasons for its absence.

use lipz_diagnostics::{Report, Severity};
use std::fmt;
use std::time::Duration;

/// The result of a run of the [`Compiler`](crate::Compiler): a bank in memory, or in files.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Compiled<B = Vec<u8>> {
    /// The verified bank: its bytes, or its file or files. `None` if there are errors, or if only a check was
    /// requested.
    pub bank: Option<B>,
    /// All diagnostics, sorted by file and position.
    pub reports: Vec<Report>,
    /// The number of clips recalled from the bank of the previous run: see
    /// [`Compiler::pack_cached`](crate::Compiler::pack_cached) and [`Memory`](crate::Memory).
    pub recalled: usize,
    /// Whether the bank was left unchanged, because no clip has changed.
    pub is_unchanged: bool,
    /// The time spent in each phase.
    pub phases: Phases,
}

impl<B> Default for Compiled<B> {
    fn default() -> Self {
        Compiled { bank: None, reports: Vec::new(), recalled: 0, is_unchanged: false, phases: Phases::default() }
    }
}

impl<B> Compiled<B> {
    /// Creates the result of a run that this report prevents.
    pub(crate) fn refused(report: Report) -> Self {
        Compiled { reports: vec![report], ..Compiled::default() }
    }

    /// Removes the bank.
    #[must_use]
    pub fn without_bank<C>(self) -> Compiled<C> {
        let Compiled { reports, recalled, is_unchanged, phases, .. } = self;
        Compiled { bank: None, reports, recalled, is_unchanged, phases }
    }

    /// Converts the bank.
    #[must_use]
    pub fn map<C>(self, change: impl FnOnce(B) -> C) -> Compiled<C> {
        self.and_then(|bank| Ok(change(bank)))
    }

    /// Processes the bank. An error is reported, and removes the bank.
    #[must_use]
    pub fn and_then<C>(self, end: impl FnOnce(B) -> Result<C, Report>) -> Compiled<C> {
        let Compiled { bank, mut reports, recalled, is_unchanged, phases } = self;
        let bank = bank.map(end).transpose().unwrap_or_else(|report| {
            reports.push(report);
            lipz_diagnostics::reports::sort(&mut reports);
            None
        });
        Compiled { bank, reports, recalled, is_unchanged, phases }
    }

    /// Returns the bank. Warnings are dropped; to show them, read `reports` before.
    ///
    /// # Errors
    /// If there is no bank. The error displays every diagnostic of the run.
    pub fn into_bank(self) -> Result<B, CompileError> {
        self.bank.ok_or(CompileError { reports: self.reports })
    }

    /// Returns the number of diagnostics at this level.
    pub fn count(&self, severity: Severity) -> usize {
        lipz_diagnostics::reports::count(&self.reports, severity)
    }
}

/// The reasons for the absence of a bank. `Display` and `Debug` list all diagnostics, one or more lines each, so that a
/// `main` that returns the error prints them.
#[derive(Clone, PartialEq, Eq)]
pub struct CompileError {
    reports: Vec<Report>,
}

impl CompileError {
    /// Returns all diagnostics of the run, sorted by file and position.
    pub fn reports(&self) -> &[Report] {
        &self.reports
    }
}

impl fmt::Display for CompileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match lipz_diagnostics::reports::count(&self.reports, Severity::Error) {
            // The run was a check.
            0 => return f.write_str("no bank was requested"),
            1 => f.write_str("1 error in Lipz files")?,
            errors => write!(f, "{errors} errors in Lipz files")?,
        }
        for report in &self.reports {
            write!(f, "\n{}", report.to_string().trim_end())?;
        }
        Ok(())
    }
}

impl fmt::Debug for CompileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl std::error::Error for CompileError {}

/// The time spent in each phase. Recalling, reading, parsing and checking run on several threads: their times are sums
/// over the threads.
#[derive(Clone, Copy, Debug, Default)]
#[non_exhaustive]
pub struct Phases {
    /// Reading the cache and its bank, and writing the cache.
    pub cache: Duration,
    /// Examining files and recalling their clips, all threads.
    pub recall: Duration,
    /// Reading files, all threads.
    pub read: Duration,
    /// Parsing, all threads; including the check of files without diagnostics, most of which takes the same pass.
    pub parse: Duration,
    /// Checking, all threads.
    pub check: Duration,
    /// Elapsed time of the four phases above.
    pub files: Duration,
    /// Resolving locales.
    pub localise: Duration,
    /// Laying out the bank; if it is made in memory, also filling it and freeing the clips.
    pub lower: Duration,
    /// When packing, filling and writing the bank, and verifying it during syncing; for a bank in memory, verifying it.
    pub finish: Duration,
}

#[cfg(test)]
mod tests {
    use crate::run::Compiler;
    use crate::sources::Input;

    #[test]
    fn the_error_lists_what_was_found() {
        let inputs = [
            Input::from_bytes("a", r#"{ "viseme_type": "blair", "visemes": "MAZ-" }"#),
            Input::from_bytes("b", r#"{ "fps": "24", "text_en-us": "" "#),
        ];
        let error = Compiler::default().compile(&inputs).into_bank().unwrap_err();
        assert_eq!(error.reports().len(), 2);
        let text = error.to_string();
        assert!(
            text.starts_with("3 errors in Lipz files\na.lipz:1:41: error[LZ0401]: `Z` is not a blair code\n"),
            "{text}"
        );
        assert!(text.contains("\nb.lipz:1:"), "{text}");
        assert_eq!(format!("{error:?}"), text);
        let checked = Compiler::default().check(&[]);
        assert_eq!(checked.into_bank().unwrap_err().to_string(), "no bank was requested");
    }
}
