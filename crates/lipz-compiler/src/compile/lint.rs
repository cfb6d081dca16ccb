//! Checks of files that are not the compiler's, made where it reads them.

use crate::Input;
use crate::compile::{Compiled, Compiler, Run};
use lipz_diagnostics::Report;

/// What a program that knows more about its project says of a file, given its bytes.
pub type Lint<'l> = dyn Fn(&Input, &[u8]) -> Linted + Send + Sync + 'l;

/// What a [`Lint`] says of a file.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct Linted {
    /// What is wrong with it.
    pub report: Option<Report>,
    /// Whether it is one of those that the program counts.
    pub is_marked: bool,
}

impl Linted {
    /// This is wrong with the file, if anything, and the program counts it or does not.
    pub fn new(report: Option<Report>, is_marked: bool) -> Linted {
        Linted { report, is_marked }
    }
}

/// The result of a check with a [`Lint`].
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct Checked {
    /// What the compiler found.
    pub compiled: Compiled,
    /// What the lint found.
    pub linted: Vec<Report>,
    /// The number of files that it marked.
    pub marked: usize,
}

impl Compiler<'_> {
    /// Checks `inputs` as [`check`](Compiler::check) does, and asks `lint` about each file that can be read.
    pub fn check_with(&self, inputs: &[Input], lint: &Lint<'_>) -> Checked {
        let mut checked = Checked::default();
        let compiled = self.run(|options| {
            let run = Run::read_with(inputs, options, None, Some(lint), &self.progress);
            checked.take(run.compare_dubs(inputs, options))
        });
        Checked { compiled, ..checked }
    }
}

impl Checked {
    /// Takes what the lint found from a run, which ends.
    pub(crate) fn take(&mut self, mut run: Run) -> Compiled {
        self.linted = std::mem::take(&mut run.linted);
        self.marked = run.stamped.marked;
        run.finish(None)
    }
}
