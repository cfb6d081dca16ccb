//! The output of a command: diagnostics, in the form of `--output-format`, and results.

use crate::{Outcome, console};
use clap::ValueEnum;
use lipz_diagnostics::render::{self, HumanStyle, to_json};
use lipz_diagnostics::{Code, Diagnostic, Report};
use serde::Serialize;
use std::io::{self, IsTerminal};
use std::path::Path;

/// How diagnostics are shown.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
pub(crate) enum ReportFormat {
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

/// The early end of a command. Only a [`Reporter`] creates one, from the diagnostics about the reason.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Abort(Outcome);

/// The result of a command, at its end or early: `?` returns from where it cannot continue.
pub(crate) type CommandResult = Result<Outcome, Abort>;

impl Abort {
    /// Returns the outcome of the command.
    pub(crate) fn outcome(self) -> Outcome {
        self.0
    }

    /// Returns the same for a command that counts as failed, whatever the reason.
    pub(crate) fn as_failure(self) -> Abort {
        Abort(Outcome::Failed)
    }
}

/// The diagnostics of one run of a command.
///
/// People see them immediately on standard error. A document for programs is printed at the end, even without
/// diagnostics. It is the only output on standard output, unless that carries a different result, such as a bank. Then
/// the document goes to standard error.
pub(crate) struct Reporter {
    format: ReportFormat,
    is_output_taken: bool,
    /// The reports for the document.
    reports: Vec<Report>,
    /// The code of the first diagnostic shown to people.
    first: Option<Code>,
    /// Whether `lipz check --fix` would fix some of the diagnostics shown.
    has_fixes: bool,
    /// Additional content of a JSON document.
    result: serde_json::Map<String, serde_json::Value>,
}

impl Reporter {
    /// Creates a reporter; `is_output_taken` if standard output carries a different result.
    pub(crate) fn new(format: ReportFormat, is_output_taken: bool) -> Reporter {
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
        if self.format != ReportFormat::Human {
            self.reports.extend(reports);
            return;
        }
        console::remark(&human(&reports));
        let mut codes = reports.iter().flat_map(|report| &report.diagnostics).map(|diagnostic| diagnostic.code);
        self.first = self.first.or_else(|| codes.next());
        self.has_fixes |= reports.iter().any(has_fixes);
    }

    /// Reports the reason why the tool could not run.
    pub(crate) fn fail(&mut self, report: Report) -> Abort {
        self.abort(vec![report], Outcome::Failed)
    }

    /// Reports errors in the input of the command.
    pub(crate) fn refuse(&mut self, reports: Vec<Report>) -> Abort {
        self.abort(reports, Outcome::Errors)
    }

    /// Reports the reason why the command cannot continue, and sets its outcome.
    pub(crate) fn abort(&mut self, reports: Vec<Report>, outcome: Outcome) -> Abort {
        self.add(reports);
        Abort(outcome)
    }

    /// Reports an incomplete or contradictory command line.
    pub(crate) fn usage(&mut self, message: impl Into<String>, help: &str) -> Abort {
        self.fail(Report::failure("", Code::Usage, message, help))
    }

    /// Prints a line for people that is not a diagnostic, on standard error.
    pub(crate) fn remark(&self, text: &str) {
        if self.format == ReportFormat::Human {
            console::remark(text);
        }
    }

    /// Prints a summary for people: on standard output, unless that carries a result.
    pub(crate) fn summary(&mut self, text: &str) -> Result<(), Abort> {
        match (self.format, self.is_output_taken) {
            (ReportFormat::Human, true) => console::remark(text),
            (ReportFormat::Human, false) => return self.print(text),
            _ => {}
        }
        Ok(())
    }

    /// Adds the data of a summary to the document, if that is JSON.
    pub(crate) fn add_result<T: Serialize>(&mut self, name: &str, value: impl FnOnce() -> T) {
        if self.format == ReportFormat::Json {
            // Our results are always serialisable.
            self.result.insert(name.to_owned(), serde_json::to_value(value()).unwrap_or_default());
        }
    }

    /// Reports diagnostics, and prints a summary for people even if there are errors.
    pub(crate) fn end(&mut self, reports: Vec<Report>, summary: Option<String>) -> CommandResult {
        let outcome = Outcome::from_reports(&reports);
        self.add(reports);
        summary.map_or(Ok(()), |summary| self.summary(&summary)).map(|()| outcome)
    }

    /// Prints a result on standard output, which is reserved for it.
    pub(crate) fn print(&mut self, text: &str) -> Result<(), Abort> {
        console::print(text).map_err(|error| self.fail(unprintable(&error)))
    }

    /// Prints a binary result.
    pub(crate) fn print_bytes(&mut self, bytes: &[u8]) -> Result<(), Abort> {
        console::print_bytes(bytes).map_err(|error| self.fail(unprintable(&error)))
    }

    /// Whether diagnostics are shown to people instead of a document for programs.
    pub(crate) fn is_for_people(&self) -> bool {
        self.format == ReportFormat::Human
    }

    /// Whether results are printed as JSON, as diagnostics are.
    pub(crate) fn wants_json(&self) -> bool {
        self.format == ReportFormat::Json
    }

    /// Prints a result as JSON.
    pub(crate) fn print_json<T: Serialize>(&mut self, value: &T) -> Result<(), Abort> {
        self.print(&to_json(value))
    }

    /// Ends one of several runs. Later diagnostics belong to the next one.
    pub(crate) fn finish_run(&mut self, ended: CommandResult) -> Outcome {
        let next = Reporter::new(self.format, self.is_output_taken);
        std::mem::replace(self, next).finish(ended)
    }

    /// Ends the run: prints the document, or a hint at further information. Returns the outcome of both.
    pub(crate) fn finish(self, ended: CommandResult) -> Outcome {
        let outcome = ended.unwrap_or_else(Abort::outcome);
        let document = match self.format {
            ReportFormat::Human => {
                if self.has_fixes {
                    console::remark("to fix them: lipz check --fix\n");
                }
                self.first.inspect(|code| hint(*code));
                return outcome;
            }
            ReportFormat::Json => render::json_with(&self.reports, &self.result),
            ReportFormat::Sarif => render::sarif(&self.reports, outcome != Outcome::Failed),
            ReportFormat::Github => render::github(&self.reports),
            ReportFormat::Gitlab => render::gitlab(&self.reports),
            ReportFormat::Junit => render::junit(&self.reports),
            ReportFormat::Concise => render::concise(&self.reports),
        };
        if self.is_output_taken {
            console::remark(&document);
            return outcome;
        }
        match console::print(&document) {
            Ok(()) => outcome,
            Err(error) => {
                // The document cannot be printed. Report that on standard error.
                console::remark(&human(&[unprintable(&error)]));
                Outcome::Failed
            }
        }
    }
}

/// Returns diagnostics for people, as wide as the terminal.
fn human(reports: &[Report]) -> String {
    HumanStyle::default().width(console::width()).styled(true).render(reports)
}

/// Returns the report that writing to standard output failed.
fn unprintable(error: &io::Error) -> Report {
    Report::about("", Diagnostic::new(Code::OutputFailed, format!("standard output cannot be written: {error}")))
}

/// Whether `lipz check --fix` would fix something. It works only on Lipz files that have names.
fn has_fixes(report: &Report) -> bool {
    let is_lipz = Path::new(&report.source.path).extension().is_some_and(|extension| extension == "lipz");
    is_lipz && report.diagnostics.iter().any(|diagnostic| diagnostic.fixes().next().is_some())
}

/// Points people at a terminal to the page of a code. Build logs do not get this hint.
fn hint(code: Code) {
    if io::stderr().is_terminal() {
        console::remark(&format!("for more about a diagnostic: lipz explain {code}\n"));
    }
}
