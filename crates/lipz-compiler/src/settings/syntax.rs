//! What is wrong with a file that is not TOML.

use lipz::diagnostic::show;
use lipz::{Code, Diagnostic, Span};
use std::collections::BTreeSet;
use toml::de::Error;

/// What the parser says of brackets without partner, at the end of what they swallowed.
const UNCLOSED: &str = "unclosed";

/// The findings for the parser's `errors`, the first of each line: those after it come of it.
pub(super) fn findings(text: &str, errors: &[Error]) -> Vec<Diagnostic> {
    if let Some(error) = errors.iter().find(|error| error.message().starts_with(UNCLOSED)) {
        return vec![finding(text, error)];
    }
    let mut lines = BTreeSet::new();
    errors.iter().filter(|error| lines.insert(line(text, start(error)))).map(|error| finding(text, error)).collect()
}

/// Whether the parser's recovery from `errors` may have made up what stands at `place`.
pub(super) fn is_made_up(text: &str, errors: &[Error], place: Span) -> bool {
    let lines = line(text, place.start as usize)..=line(text, place.end as usize);
    errors.iter().any(|error| error.message().starts_with(UNCLOSED) || lines.contains(&line(text, start(error))))
}

fn start(error: &Error) -> usize {
    error.span().map_or(0, |span| span.start)
}

/// The number of line ends before byte `at`.
fn line(text: &str, at: usize) -> usize {
    text.bytes().take(at).filter(|&byte| byte == b'\n').count()
}

fn finding(text: &str, error: &Error) -> Diagnostic {
    let place = error.span().unwrap_or_default();
    let written = text.get(place.clone()).unwrap_or_default();
    let message = error.message();
    let described = show::text(message);
    let (headline, help) = if message.starts_with("string values must be quoted") {
        match written {
            "" => ("a value is missing".to_owned(), "write a value behind the `=`, or remove the line".to_owned()),
            word => {
                (format!("{} is a text without quotes", show::name(word)), format!("write \"{}\"", show::text(word)))
            }
        }
    } else if message.starts_with("duplicate key") {
        (format!("{} appears twice", show::name(written)), "join the two, or remove one".to_owned())
    } else if message.starts_with("missing escaped value") {
        ("`\\` starts an escape, and none follows".to_owned(), "write `/` in paths, on every system".to_owned())
    } else if message.starts_with("invalid boolean") {
        (format!("{} is neither true nor false", show::name(written)), "write true or false".to_owned())
    } else if message.starts_with("key with no value") {
        ("a name has no value".to_owned(), "write name = value, as in default-fps = 24".to_owned())
    } else {
        let help = "texts stand in \"…\", lists in […], and each setting on a line of its own";
        (format!("this is not TOML: {described}"), help.to_owned())
    };
    Diagnostic::at(Code::SettingsSyntax, Span::new(place.start, place.end), headline).help(help)
}
