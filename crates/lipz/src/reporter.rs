//! The one channel on which a command tells what it found, in the form that `--format` names.

use crate::{Outcome, console};
use clap::ValueEnum;
use lipz_diagnostics::{
    Code, Report,
    render::{self, Human},
};
use std::io::{self, IsTerminal};

/// How diagnostics are shown.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
pub(crate) enum Format {
    /// Text with the marked source
    Human,
    /// One JSON document with every diagnostic
    Json,
    /// One SARIF 2.1.0 document with every diagnostic
    Sarif,
    /// Annotations of GitHub Actions, one a line
    Github,
}

/// The diagnostics of one run of a command.
///
/// People see them as they come, on standard error. A document for programs is printed at the end,
/// also if nothing was found. It is then all that standard output has; only if that is for another
/// result, such as a bank, the document goes to standard error.
pub(crate) struct Reporter {
    format: Format,
    is_output_taken: bool,
    /// What the document is about.
    reports: Vec<Report>,
    /// The code of the first one that people saw.
    first: Option<Code>,
}

impl Reporter {
    /// `is_output_taken` if standard output is for something else.
    pub(crate) fn new(format: Format, is_output_taken: bool) -> Reporter {
        Reporter { format, is_output_taken, reports: Vec::new(), first: None }
    }

    /// A reporter for another run, which shows diagnostics in the same way.
    pub(crate) fn for_next_run(&self) -> Reporter {
        Reporter::new(self.format, self.is_output_taken)
    }

    /// Shows these diagnostics, or keeps them for the document.
    pub(crate) fn add(&mut self, reports: Vec<Report>) {
        if self.format != Format::Human {
            self.reports.extend(reports);
            return;
        }
        console::remark(&Human::default().width(console::width()).styled(true).render(&reports));
        let mut codes = reports.iter().flat_map(|report| &report.diagnostics).map(|diagnostic| diagnostic.code);
        self.first = self.first.or_else(|| codes.next());
    }

    /// Shows why the command cannot go on.
    pub(crate) fn fail(&mut self, report: Report) -> Outcome {
        self.add(vec![report]);
        Outcome::Failed
    }

    /// Tells people what the command did.
    pub(crate) fn summary(&self, text: &str) -> Outcome {
        if self.format == Format::Human { self.print(text) } else { Outcome::Clean }
    }

    /// Ends the run: prints the document, or where people find more. Gives the outcome of both.
    pub(crate) fn finish(self, outcome: Outcome) -> Outcome {
        let document = match self.format {
            Format::Human => {
                self.first.inspect(|code| hint(*code));
                return outcome;
            }
            Format::Json => render::json(&self.reports),
            Format::Sarif => render::sarif(&self.reports, outcome != Outcome::Failed),
            Format::Github => render::github(&self.reports),
        };
        self.print(&document).max(outcome)
    }

    fn print(&self, text: &str) -> Outcome {
        if self.is_output_taken {
            console::remark(text);
            return Outcome::Clean;
        }
        console::print(text)
    }
}

/// Tells people at a terminal where more about a code is. Logs of builds go without.
fn hint(code: Code) {
    if io::stderr().is_terminal() {
        console::remark(&format!("for more about a diagnostic: lipz explain {code}\n"));
    }
}
