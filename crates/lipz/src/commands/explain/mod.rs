//! `lipz explain`: the pages about codes.

mod markdown;

use crate::Ended;
use crate::commands::Run;
use crate::reporter::Reporter;
use crate::{Outcome, console};
use clap::Args;
use lipz_diagnostics::{Code, Report, escape, suggest};
use std::fmt::Write;

/// Explain a rule by its code: what it reports, why, an example, and the fix.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz explain LZ0401
  lipz explain 401
  lipz explain foreign-code
  lipz explain --list")]
pub(crate) struct Explain {
    /// The code or name of a rule; without it, all are listed
    #[arg(value_name = "CODE")]
    code: Option<String>,

    /// List all rules
    #[arg(long, conflicts_with = "code")]
    list: bool,
}

impl Run for Explain {
    fn prints_result(&self) -> bool {
        true
    }

    fn run(&self, reporter: &mut Reporter) -> Ended {
        let Some(text) = &self.code else {
            reporter.print(&list())?;
            return Ok(Outcome::Clean);
        };
        // As diagnostics show it, `error[LZ0401]:`, it can be copied here.
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

/// The codes by group, one a line.
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

/// The level of a rule, unless a project sets another.
pub(super) fn default_level(code: Code) -> String {
    if code.is_allowed_by_default() { "allowed".to_owned() } else { code.default_severity().to_string() }
}

/// The code that has only its number, or this without zeros, for a name: `401`, `LZ401`.
fn numbered(text: &str) -> Option<String> {
    let number =
        text.get(..2).filter(|start| start.eq_ignore_ascii_case("lz")).map_or(text, |start| &text[start.len()..]);
    let number: u16 = number.parse().ok()?;
    Some(format!("LZ{number:04}"))
}

/// What to do about a code that does not exist. Numbers are all alike: only names have a nearest one.
fn instead(text: &str) -> String {
    match suggest::nearest(text, Code::ALL.iter().map(|code| code.name())) {
        Some(name) => format!("did you mean `{name}`?"),
        None => "`lipz explain --list` lists the rules".to_owned(),
    }
}
