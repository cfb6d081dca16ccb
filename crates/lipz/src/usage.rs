//! Diagnostics for command lines that clap refuses.

use crate::console;
use crate::outcome::Outcome;
use crate::renamed;
use crate::reporter::{ReportFormat, Reporter};
use clap::ValueEnum;
use clap::error::ErrorKind;
use lipz_diagnostics::{Code, Diagnostic, Report};
use std::ffi::OsString;

/// Prints help and versions, which clap returns as errors, and reports real errors in the format that `arguments` name.
/// Scripts find them on standard output, which carries no other result at this point.
pub(crate) fn end(error: &clap::Error, arguments: impl Iterator<Item = OsString>) -> Outcome {
    let text = error.render().ansi().to_string();
    if !error.use_stderr() {
        let mut reporter = Reporter::new(ReportFormat::Human, true);
        let ended = reporter.print(&text).map(|()| Outcome::Clean);
        return reporter.finish(ended);
    }
    let format = format(arguments);
    let is_help = error.kind() == ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand;
    if is_help && format == ReportFormat::Human {
        console::remark(&text);
        return Outcome::Failed;
    }
    let mut reporter = Reporter::new(format, false);
    let abort = match is_help {
        true => reporter.usage("no command is named", "list the commands with `lipz --help`"),
        false => {
            let mut diagnostic = diagnostic(&error.render().to_string());
            diagnostic.help = renamed::help(error).or(diagnostic.help);
            reporter.fail(Report::about("", diagnostic))
        }
    };
    reporter.finish(Err(abort))
}

/// Returns the format in the arguments, as far as it can be found in an invalid command line.
fn format(arguments: impl Iterator<Item = OsString>) -> ReportFormat {
    let mut arguments = arguments.take_while(|argument| argument != "--");
    let mut named = || {
        loop {
            let argument = arguments.next()?;
            let value = match argument.to_str() {
                Some("--output-format") => arguments.next()?.into_string().ok(),
                Some(text) => text.strip_prefix("--output-format=").map(str::to_owned),
                None => None,
            };
            if let Some(format) = value.and_then(|value| ReportFormat::from_str(&value, false).ok()) {
                return Some(format);
            }
        }
    };
    named().unwrap_or(ReportFormat::Human)
}

/// Converts clap's text to a diagnostic: a message, tips, the usage of the command, and where to find more.
fn diagnostic(text: &str) -> Diagnostic {
    let mut paragraphs = text.trim_end().split("\n\n");
    let first = paragraphs.next().unwrap_or_default();
    let mut lines = first.lines().map(str::trim);
    let mut message = lines.next().unwrap_or_default().trim_start_matches("error: ").to_owned();
    let others: Vec<&str> = lines.map(|line| line.trim_matches(['[', ']'])).collect();
    let mut diagnostic = if message.ends_with(':') {
        message = format!("{message} {}", others.join(", "));
        Diagnostic::new(Code::Usage, message)
    } else {
        others.into_iter().fold(Diagnostic::new(Code::Usage, message), Diagnostic::note)
    };
    let mut help = Vec::new();
    let mut more = None;
    for paragraph in paragraphs {
        let tips = paragraph.lines().filter_map(|line| line.trim().strip_prefix("tip: "));
        help.extend(tips);
        if let Some(usage) = paragraph.strip_prefix("Usage: ") {
            diagnostic = diagnostic.note(format!("usage: {}", usage.split_whitespace().collect::<Vec<_>>().join(" ")));
        } else if paragraph.starts_with("For more information") {
            more = Some(paragraph.to_lowercase().trim_end_matches('.').to_owned());
        }
    }
    match (help.is_empty(), more) {
        (false, _) => diagnostic.help(help.join("; ")),
        (true, Some(more)) => diagnostic.help(more),
        (true, None) => diagnostic,
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use crate::args::Arguments;
    use clap::Parser;

    fn refused(line: &str) -> Diagnostic {
        let error = Arguments::try_parse_from(line.split(' ')).unwrap_err();
        diagnostic(&error.render().to_string())
    }

    #[test]
    fn the_parts_of_what_clap_says() {
        let unknown = refused("lipz check --fixx");
        assert_eq!(unknown.message, "unexpected argument '--fixx' found");
        assert_eq!(unknown.notes, ["usage: lipz check --fix [SOURCES]..."]);
        assert_eq!(unknown.help.as_deref(), Some("a similar argument exists: '--fix'"));

        let missing = refused("lipz unpack");
        assert_eq!(missing.message, "the following required arguments were not provided: --output <FOLDER>, <BANK>");
        assert_eq!(missing.notes, ["usage: lipz unpack <BANK> --output <FOLDER> [OPTIONS]"]);
        assert_eq!(missing.help.as_deref(), Some("for more information, try '--help'"));

        let wrong = refused("lipz check --output-format xml");
        assert_eq!(wrong.message, "invalid value 'xml' for '--output-format <FORMAT>'");
        assert_eq!(wrong.notes.first().unwrap(), "possible values: human, json, sarif, github, gitlab, junit, concise");
    }

    #[test]
    fn the_format_is_found_in_any_command_line() {
        let found = |line: &str| format(line.split(' ').map(OsString::from));
        assert_eq!(found("lipz --output-format json"), ReportFormat::Json);
        assert_eq!(found("lipz pakc --output-format=sarif -x"), ReportFormat::Sarif);
        for none in [
            "lipz check",
            "lipz check --output-format",
            "lipz check --output-format xml",
            "lipz check -- --output-format json",
        ] {
            assert_eq!(found(none), ReportFormat::Human, "{none}");
        }
        assert_eq!(found("lipz --output-format xml --output-format github"), ReportFormat::Github);
    }
}
