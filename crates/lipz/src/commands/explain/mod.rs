//! `lipz explain`: the pages of rules.

mod markdown;

use crate::CommandResult;
use crate::commands::Run;
use crate::reporter::Reporter;
use crate::{Outcome, console};
use clap::Args;
use lipz_diagnostics::{Code, Report, escape, suggest};
use std::fmt::Write;

/// Explain a rule: its meaning, an example and the fix.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz explain LZ0401
  lipz explain 401
  lipz explain foreign-code
  lipz explain")]
pub(crate) struct Explain {
    /// Code or name of a rule [default: list all rules]
    #[arg(value_name = "CODE")]
    code: Option<String>,
}

impl Run for Explain {
    fn prints_result(&self) -> bool {
        true
    }

    fn run(&self, reporter: &mut Reporter) -> CommandResult {
        let Some(text) = &self.code else {
            reporter.print(&list())?;
            return Ok(Outcome::Clean);
        };
        // Accept the form from diagnostics, such as `error[LZ0401]:`, because people paste it.
        let copied = text.rsplit('[').next().unwrap_or(text).trim_end_matches([':', ']']);
        match numbered(copied).as_deref().unwrap_or(copied).parse() {
            Ok(code) => reporter.print(&markdown::terminal(code, console::width())).map(|()| Outcome::Clean),
            Err(_) => {
                let message = format!("no rule is called {}", escape::quoted(text));
                Err(reporter.fail(Report::failure("", Code::NoSuchRule, message, &instead(text))))
            }
        }
    }
}

/// Returns the codes by group, one per line.
fn list() -> String {
    let width = Code::ALL.iter().map(|code| code.name().len()).max().unwrap_or(0);
    let mut text = String::new();
    for group in Code::ALL.chunk_by(|a, b| a.group() == b.group()) {
        let title = group.first().map_or("", |code| code.group());
        let _ = writeln!(text, "{}{}", if text.is_empty() { "" } else { "\n" }, markdown::heading(title));
        for code in group {
            let (name, level) = (code.name(), default_level(*code));
            let _ = writeln!(text, "  {code}  {name:width$}  {level:7}  {}", code.summary());
        }
    }
    text
}

/// Returns the level of a rule, unless a project sets a different one.
pub(super) fn default_level(code: Code) -> String {
    if code.is_allowed_by_default() { "allowed".to_owned() } else { code.default_severity().to_string() }
}

/// Returns the full code for a number, with or without prefix and zeros: `401`, `LZ401`.
fn numbered(text: &str) -> Option<String> {
    let number =
        text.get(..2).filter(|start| start.eq_ignore_ascii_case("lz")).map_or(text, |start| &text[start.len()..]);
    let number: u16 = number.parse().ok()?;
    Some(format!("LZ{number:04}"))
}

/// Returns the help for an unknown code. All numbers look alike, so that only for names a similar one is suggested.
fn instead(text: &str) -> String {
    match suggest::nearest(text, Code::ALL.iter().map(|code| code.name())) {
        Some(name) => format!("did you mean `{name}`?"),
        None => "list the rules with `lipz explain`".to_owned(),
    }
}
