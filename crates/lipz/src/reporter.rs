//! The one channel on which a command reports diagnostics, in the form that `--format` names, and prints results.

use crate::{Outcome, console};
use clap::ValueEnum;
use lipz_diagnostics::render::{self, Human, to_json};
use lipz_diagnostics::{Code, Diagnostic, Report};
use serde::Serialize;
use std::io::{self, IsTerminal};
use std::path::Path;

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
    /// One Code Quality report of GitLab
    Gitlab,
    /// One JUnit report: errors are failed tests
    Junit,
    /// One line per diagnostic, for editors and grep
    Concise,
}

/// The end of a command that cannot go on. Only a [`Reporter`] makes one, from the diagnostics that say why.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Abort(Outcome);

/// How a command ended, at its end or early: `?` leaves it where it cannot go on.
pub(crate) type Ended = Result<Outcome, Abort>;

impl Abort {
    /// How the command ends.
    pub(crate) fn outcome(self) -> Outcome {
        self.0
    }

    /// The same for a command that then fails, whatever the reason.
    pub(crate) fn as_failure(self) -> Abort {
        Abort(Outcome::Failed)
    }
}

/// The diagnostics of one run of a command.
///
/// People see them as they come, on standard error. A document for programs is printed at the end,
/// also if there are none. It is then all that standard output has; only if that is for another
/// result, such as a bank, the document goes to standard error.
pub(crate) struct Reporter {
    format: Format,
    is_output_taken: bool,
    /// What the document is about.
    reports: Vec<Report>,
    /// The code of the first one that people saw.
    first: Option<Code>,
    /// Whether `lipz check --fix` would fix some of those that they saw.
    has_fixes: bool,
    /// What a JSON document has besides.
    result: serde_json::Map<String, serde_json::Value>,
}

impl Reporter {
    /// `is_output_taken` if standard output is for something else.
    pub(crate) fn new(format: Format, is_output_taken: bool) -> Reporter {
        Reporter {
            format,
            is_output_taken,
            reports: Vec::new(),
            first: None,
            has_fixes: false,
            result: serde_json::Map::new(),
        }
    }

    /// Shows these diagnostics, or keeps them for the document.
    pub(crate) fn add(&mut self, reports: Vec<Report>) {
        if self.format != Format::Human {
            self.reports.extend(reports);
            return;
        }
        console::remark(&human(&reports));
        let mut codes = reports.iter().flat_map(|report| &report.diagnostics).map(|diagnostic| diagnostic.code);
        self.first = self.first.or_else(|| codes.next());
        self.has_fixes |= reports.iter().any(has_fixes);
    }

    /// Reports why the tool could not run.
    pub(crate) fn fail(&mut self, report: Report) -> Abort {
        self.abort(vec![report], Outcome::Failed)
    }

    /// Reports errors in what the command was given.
    pub(crate) fn refuse(&mut self, reports: Vec<Report>) -> Abort {
        self.abort(reports, Outcome::Errors)
    }

    /// Reports why the command cannot go on, and how it ends.
    pub(crate) fn abort(&mut self, reports: Vec<Report>, outcome: Outcome) -> Abort {
        self.add(reports);
        Abort(outcome)
    }

    /// Reports that the command line is not enough or contradicts itself.
    pub(crate) fn usage(&mut self, message: impl Into<String>, help: &str) -> Abort {
        self.fail(Report::failure("", Code::Usage, message, help))
    }

    /// Prints a line for people that is no diagnostic, on standard error.
    pub(crate) fn remark(&self, text: &str) {
        if self.format == Format::Human {
            console::remark(text);
        }
    }

    /// Prints for people what the command did: on standard output, unless that is for a result.
    pub(crate) fn summary(&mut self, text: &str) -> Result<(), Abort> {
        match (self.format, self.is_output_taken) {
            (Format::Human, true) => console::remark(text),
            (Format::Human, false) => return self.print(text),
            _ => {}
        }
        Ok(())
    }

    /// Adds what the command did to the document, if that is JSON: what a summary tells people.
    pub(crate) fn add_result<T: Serialize>(&mut self, name: &str, value: impl FnOnce() -> T) {
        if self.format == Format::Json {
            // Of what cannot be serialised, there is nothing in our results.
            self.result.insert(name.to_owned(), serde_json::to_value(value()).unwrap_or_default());
        }
    }

    /// Reports what was found, and prints for people what the command did all the same.
    pub(crate) fn end(&mut self, reports: Vec<Report>, summary: Option<String>) -> Ended {
        let outcome = Outcome::from_reports(&reports);
        self.add(reports);
        summary.map_or(Ok(()), |summary| self.summary(&summary)).map(|()| outcome)
    }

    /// Prints a result on standard output, which is for that.
    pub(crate) fn print(&mut self, text: &str) -> Result<(), Abort> {
        console::print(text).map_err(|error| self.fail(unprintable(&error)))
    }

    /// Prints a result that is not text.
    pub(crate) fn print_bytes(&mut self, bytes: &[u8]) -> Result<(), Abort> {
        console::print_bytes(bytes).map_err(|error| self.fail(unprintable(&error)))
    }

    /// Whether people see the diagnostics, and no program reads a document of them.
    pub(crate) fn is_for_people(&self) -> bool {
        self.format == Format::Human
    }

    /// Whether results are printed as JSON: with `--json`, and where diagnostics are JSON, too.
    pub(crate) fn wants_json(&self, flag: bool) -> bool {
        flag || self.format == Format::Json
    }

    /// Prints a result as JSON.
    pub(crate) fn print_json<T: Serialize>(&mut self, value: &T) -> Result<(), Abort> {
        self.print(&to_json(value))
    }

    /// Ends one of several runs. What follows belongs to the next one.
    pub(crate) fn finish_run(&mut self, ended: Ended) -> Outcome {
        let next = Reporter::new(self.format, self.is_output_taken);
        std::mem::replace(self, next).finish(ended)
    }

    /// Ends the run: prints the document, or where people find more. Returns the outcome of both.
    pub(crate) fn finish(self, ended: Ended) -> Outcome {
        let outcome = ended.unwrap_or_else(Abort::outcome);
        let document = match self.format {
            Format::Human => {
                if self.has_fixes {
                    console::remark("to fix them: lipz check --fix\n");
                }
                self.first.inspect(|code| hint(*code));
                return outcome;
            }
            Format::Json => render::json_with(&self.reports, &self.result),
            Format::Sarif => render::sarif(&self.reports, outcome != Outcome::Failed),
            Format::Github => render::github(&self.reports),
            Format::Gitlab => render::gitlab(&self.reports),
            Format::Junit => render::junit(&self.reports),
            Format::Concise => render::concise(&self.reports),
        };
        if self.is_output_taken {
            console::remark(&document);
            return outcome;
        }
        match console::print(&document) {
            Ok(()) => outcome,
            Err(error) => {
                // The document has no other way out: this is for whoever looks for it.
                console::remark(&human(&[unprintable(&error)]));
                Outcome::Failed
            }
        }
    }
}

/// Diagnostics for people, as wide as the terminal.
fn human(reports: &[Report]) -> String {
    Human::default().width(console::width()).styled(true).render(reports)
}

/// Why standard output takes nothing.
fn unprintable(error: &io::Error) -> Report {
    Report::about("", Diagnostic::new(Code::OutputFailed, format!("standard output cannot be written: {error}")))
}

/// Whether `lipz check --fix` would fix something: it does so in Lipz files that have names.
fn has_fixes(report: &Report) -> bool {
    let is_lipz = Path::new(&report.source.path).extension().is_some_and(|extension| extension == "lipz");
    is_lipz && report.diagnostics.iter().any(|diagnostic| diagnostic.fix.is_some())
}

/// Tells people at a terminal where more about a code is. Logs of builds go without.
fn hint(code: Code) {
    if io::stderr().is_terminal() {
        console::remark(&format!("for more about a diagnostic: lipz explain {code}\n"));
    }
}
