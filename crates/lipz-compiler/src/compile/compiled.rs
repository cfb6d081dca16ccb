//! The result of a run: a bank, or the reasons why there is none.

use lipz_diagnostics::{Report, Severity};
use std::fmt;
use std::time::Duration;

/// The result of a run of the [`Compiler`](crate::Compiler): a bank in memory, or in files.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Compiled<B = Vec<u8>> {
    /// The bank, verified: its bytes, or the file or files in which it is. `None` if there are errors, or only a check was asked
    /// for.
    pub bank: Option<B>,
    /// All diagnostics, sorted by file and place.
    pub reports: Vec<Report>,
    /// Clips that were recalled from the bank of the previous run: see [`Compiler::pack_cached`](crate::Compiler::pack_cached)
    /// and [`Memory`](crate::Memory).
    pub recalled: usize,
    /// Whether the bank was left as it is, because no clip changed.
    pub is_unchanged: bool,
    /// Where the time went.
    pub phases: Phases,
}

impl<B> Default for Compiled<B> {
    fn default() -> Self {
        Compiled { bank: None, reports: Vec::new(), recalled: 0, is_unchanged: false, phases: Phases::default() }
    }
}

impl<B> Compiled<B> {
    /// A run that this report keeps from starting.
    pub(crate) fn refused(report: Report) -> Self {
        Compiled { reports: vec![report], ..Compiled::default() }
    }

    /// The same without the bank.
    #[must_use]
    pub fn without_bank<C>(self) -> Compiled<C> {
        let Compiled { reports, recalled, is_unchanged, phases, .. } = self;
        Compiled { bank: None, reports, recalled, is_unchanged, phases }
    }

    /// The same with the bank as something else.
    #[must_use]
    pub fn map<C>(self, change: impl FnOnce(B) -> C) -> Compiled<C> {
        self.and_then(|bank| Ok(change(bank)))
    }

    /// Does something with the bank; what is wrong with that is reported, and there is no bank then.
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

    /// The bank. Warnings are dropped; read `reports` before to show them.
    ///
    /// # Errors
    /// If there is no bank. The error displays every diagnostic of the run.
    pub fn into_bank(self) -> Result<B, CompileError> {
        self.bank.ok_or(CompileError { reports: self.reports })
    }

    /// The number of diagnostics at this level.
    pub fn count(&self, severity: Severity) -> usize {
        lipz_diagnostics::reports::count(&self.reports, severity)
    }
}

/// The reason why there is no bank. `Display` and `Debug` list all diagnostics, one or more lines each, so
/// that a `main` that returns the error prints them.
#[derive(Clone, PartialEq, Eq)]
pub struct CompileError {
    reports: Vec<Report>,
}

impl CompileError {
    /// All diagnostics of the run, sorted by file and place.
    pub fn reports(&self) -> &[Report] {
        &self.reports
    }
}

impl fmt::Display for CompileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match lipz_diagnostics::reports::count(&self.reports, Severity::Error) {
            // Of a check.
            0 => return f.write_str("no bank was asked for"),
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

/// Time spent per phase. Recalling, reading, parsing and checking run on several threads: their
/// times are sums over the threads.
#[derive(Clone, Copy, Debug, Default)]
#[non_exhaustive]
pub struct Phases {
    /// Reading the cache and its bank, and writing the cache.
    pub cache: Duration,
    /// Looking at files and recalling their clips, all threads.
    pub recall: Duration,
    /// Reading files, all threads.
    pub read: Duration,
    /// Parsing, all threads; with the check of files without diagnostics, which mostly takes the same pass.
    pub parse: Duration,
    /// Checking, all threads.
    pub check: Duration,
    /// The four above, on the clock.
    pub files: Duration,
    /// Resolving locales.
    pub localise: Duration,
    /// Laying out the bank; and filling it and freeing the clips, where it is made in memory.
    pub lower: Duration,
    /// When packing, filling and writing the bank, and verifying it while it is brought to disk; of a bank in memory, verifying it.
    pub finish: Duration,
}

#[cfg(test)]
mod tests {
    use crate::{Compiler, Input};

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
        assert_eq!(checked.into_bank().unwrap_err().to_string(), "no bank was asked for");
    }
}
