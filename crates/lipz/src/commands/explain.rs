//! `lipz explain`: the pages about codes.

use crate::{Outcome, console, page};
use clap::Args;
use lipz_diagnostics::{Code, escape, suggest};
use std::fmt::Write;

/// Explain a code of a finding: what it is about, why, an example, what to do.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz explain LZ0401
  lipz explain foreign-code
  lipz explain --list")]
pub(crate) struct Explain {
    /// The code by number or name; without it, all are listed
    #[arg(value_name = "CODE")]
    code: Option<String>,

    /// List all codes
    #[arg(long, conflicts_with = "code")]
    list: bool,
}

pub(crate) fn run(arguments: &Explain) -> Outcome {
    let Some(text) = &arguments.code else { return console::print(&list()) };
    // As findings show it, `error[LZ0401]:`, it can be copied here.
    let copied = text.rsplit('[').next().unwrap_or(text).trim_end_matches([':', ']']);
    match copied.parse() {
        Ok(code) => console::print(&page::terminal(code, console::width())),
        Err(_) => {
            console::remark(&format!(
                "error: {} is not a code of lipz\nhelp: {}\n",
                escape::quoted(text),
                instead(text)
            ));
            Outcome::Failed
        }
    }
}

/// The codes by group, one a line.
fn list() -> String {
    let width = Code::ALL.iter().map(|code| code.name().len()).max().unwrap_or(0);
    let mut text = String::new();
    for group in Code::ALL.chunk_by(|a, b| a.group() == b.group()) {
        let title = group.first().map_or("", |code| code.group());
        let _ = writeln!(text, "{}{}", if text.is_empty() { "" } else { "\n" }, page::heading(title));
        for code in group {
            let (name, level) = (code.name(), code.default_severity().to_string());
            let _ = writeln!(text, "  {code}  {name:width$}  {level:7}  {}", code.summary());
        }
    }
    text
}

/// What to do about a code that does not exist. Numbers are all alike: only names have a nearest one.
fn instead(text: &str) -> String {
    match suggest::nearest(text, Code::ALL.iter().map(|code| code.name())) {
        Some(name) => format!("did you mean `{name}`?"),
        None => "`lipz explain --list` lists the codes".to_owned(),
    }
}
