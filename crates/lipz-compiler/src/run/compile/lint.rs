//! Additional checks by the calling program, run when the compiler reads a file.

use crate::sources::Input;
use lipz_diagnostics::Report;

/// A check by a program with additional knowledge of its project, from a file and its bytes.
pub type Lint<'l> = dyn Fn(&Input, &[u8]) -> LintResult + Send + Sync + 'l;

/// The result of a [`Lint`] for a file.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct LintResult {
    /// The diagnostics of the file.
    pub report: Option<Report>,
    /// Whether the program counts the file.
    pub is_marked: bool,
}

impl LintResult {
    /// Creates the result from the diagnostics of the file, if any, and from whether the program counts it.
    pub fn new(report: Option<Report>, is_marked: bool) -> LintResult {
        LintResult { report, is_marked }
    }
}
