//! Checking with an additional lint of the calling program.

use super::run::CompileRun;
use super::{Compiled, Compiler, Lint};
use crate::sources::Input;
use lipz_diagnostics::Report;

/// The result of a check with a [`Lint`].
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct CheckResult {
    /// The results of the compiler.
    pub compiled: Compiled,
    /// The reports of the lint.
    pub linted: Vec<Report>,
    /// The number of files that it marked.
    pub marked: usize,
}

impl Compiler<'_> {
    /// Checks `inputs` like [`check`](Compiler::check), and calls `lint` for each readable file.
    pub fn check_with(&self, inputs: &[Input], lint: &Lint<'_>) -> CheckResult {
        let mut checked = CheckResult::default();
        let compiled = self.compile_in_pool(|options| {
            let run = CompileRun::read_with(inputs, options, None, Some(lint), &self.progress);
            checked.take(run.compare_dubs(inputs, options))
        });
        CheckResult { compiled, ..checked }
    }
}

impl CheckResult {
    /// Takes the reports of the lint from a run, and ends the run.
    pub(crate) fn take(&mut self, mut run: CompileRun) -> Compiled {
        self.linted = std::mem::take(&mut run.linted);
        self.marked = run.marked;
        run.finish(None)
    }
}
