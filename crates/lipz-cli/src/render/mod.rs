//! Findings, for people and for programs.

mod github;
mod human;
mod json;
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
    first: Option<Code>,
    /// What the document at the end is about, once it is due.
    reports: Option<Vec<Report>>,
}

impl Findings {
    pub(crate) fn new(format: Format) -> Findings {
        Findings { format, first: None, reports: None }
    }

    /// Shows these findings, or keeps them for the document.
    pub(crate) fn add(&mut self, reports: Vec<Report>) {
        let code = reports.iter().flat_map(|report| &report.diagnostics).map(|found| found.code).next();
        self.first = self.first.or(code);
        match self.format {
            Format::Human => human::print(&reports),
            Format::Github => {
                console::print(&github::annotations(&reports));
            }
            Format::Json | Format::Sarif => self.reports.get_or_insert_default().extend(reports),
        }
    }

    /// Says what the command did, unless standard output is for a document.
    pub(crate) fn summary(&mut self, text: &str) -> Outcome {
        match self.format {
            Format::Human | Format::Github => console::print(text),
            Format::Json | Format::Sarif => {
                self.reports.get_or_insert_default();
                Outcome::Clean
            }
        }
    }

    /// Ends the run: prints the document, or where people find more. Gives the outcome of both.
    pub(crate) fn finish(self, outcome: Outcome) -> Outcome {
        let printed = match (self.format, self.reports, self.first) {
            (Format::Json, Some(reports), _) => console::print_json(&json::Document::of(&reports)),
            (Format::Sarif, Some(reports), _) => console::print_json(&sarif::document(&reports, outcome)),
            (Format::Human, _, Some(code)) => human::hint(code),
            _ => Outcome::Clean,
        };
        if printed == Outcome::Clean { outcome } else { printed }
    }
}
