//! Findings, for people and for programs.

mod github;
mod human;
mod json;
mod places;
mod sarif;

use crate::{Outcome, console};
use clap::ValueEnum;
use lipz::Code;
use lipz_compiler::Report;

/// How findings are shown.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
pub(crate) enum Format {
    /// Text with the marked source
    Human,
    /// One JSON document with every finding
    Json,
    /// One SARIF 2.1.0 document with every finding
    Sarif,
    /// Annotations of GitHub Actions, one a line
    Github,
}

/// The findings of one run of a command.
///
/// People see them as they come, on standard error. A document for programs is printed at the end,
/// also if nothing was found. It is then all that standard output has; only if that is for another
/// result, such as a bank, the document goes to standard error.
pub(crate) struct Findings {
    format: Format,
    is_output_taken: bool,
    /// What the document is about.
    reports: Vec<Report>,
    /// The code of the first one that people saw.
    first: Option<Code>,
}

impl Findings {
    /// `is_output_taken` if standard output is for something else.
    pub(crate) fn new(format: Format, is_output_taken: bool) -> Findings {
        Findings { format, is_output_taken, reports: Vec::new(), first: None }
    }

    /// The findings of another run, shown in the same way.
    pub(crate) fn of_next_run(&self) -> Findings {
        Findings::new(self.format, self.is_output_taken)
    }

    /// Shows these findings, or keeps them for the document.
    pub(crate) fn add(&mut self, reports: Vec<Report>) {
        if self.format != Format::Human {
            self.reports.extend(reports);
            return;
        }
        human::print(&reports);
        let mut codes = reports.iter().flat_map(|report| &report.diagnostics).map(|found| found.code);
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
                self.first.inspect(|code| human::hint(*code));
                return outcome;
            }
            Format::Json => console::json(&json::Document::of(&self.reports)),
            Format::Sarif => console::json(&sarif::document(&self.reports, outcome)),
            Format::Github => Ok(github::annotations(&self.reports)),
        };
        document.map_or_else(|failed| failed, |text| self.print(&text)).max(outcome)
    }

    fn print(&self, text: &str) -> Outcome {
        if self.is_output_taken {
            console::remark(text);
            return Outcome::Clean;
        }
        console::print(text)
    }
}
