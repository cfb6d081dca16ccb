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
    /// Text with the marked source, on standard error
    Human,
    /// One JSON document with every finding, on standard output
    Json,
    /// One SARIF 2.1.0 document with every finding, on standard output
    Sarif,
    /// Annotations of GitHub Actions, one a line, on standard output
    Github,
}

/// The findings of one run of a command.
///
/// People see them as they come. A document for programs is printed at the end, and is then all that
/// standard output has. It is due also without findings, except from commands whose result is
/// something else, as that of `inspect`: these print one only if they have findings instead.
pub(crate) struct Findings {
    format: Format,
    /// The code of the first one.
    first: Option<Code>,
    /// What the document is about, once it is due.
    reports: Option<Vec<Report>>,
}

impl Findings {
    pub(crate) fn new(format: Format) -> Findings {
        Findings { format, first: None, reports: None }
    }

    /// Shows these findings, or keeps them for the document.
    pub(crate) fn add(&mut self, reports: Vec<Report>) {
        if self.format != Format::Human {
            self.reports.get_or_insert_default().extend(reports);
            return;
        }
        human::print(&reports);
        let mut codes = reports.iter().flat_map(|report| &report.diagnostics).map(|found| found.code);
        self.first = self.first.or_else(|| codes.next());
    }

    /// Says what the command did, unless standard output is for a document.
    pub(crate) fn summary(&mut self, text: &str) -> Outcome {
        if self.format == Format::Human {
            return console::print(text);
        }
        self.reports.get_or_insert_default();
        Outcome::Clean
    }

    /// Ends the run: prints the document, or where people find more. Gives the outcome of both.
    pub(crate) fn finish(self, outcome: Outcome) -> Outcome {
        if let Some(code) = self.first {
            human::hint(code);
        }
        let Some(reports) = self.reports else { return outcome };
        let printed = match self.format {
            Format::Human => Outcome::Clean,
            Format::Json => console::print_json(&json::Document::of(&reports)),
            Format::Sarif => console::print_json(&sarif::document(&reports, outcome)),
            Format::Github => console::print(&github::annotations(&reports)),
        };
        if printed == Outcome::Clean { outcome } else { printed }
    }
}
