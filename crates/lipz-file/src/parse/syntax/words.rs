//! Words without quotes, with other quotes, numbers that are none, other signs for the colon.

use super::Expected;
use super::place::Place;
use lipz_diagnostics::{Code, Diagnostic, Span};

pub(super) fn explain(at: &Place<'_>, expected: Expected) -> Option<Diagnostic> {
    match (expected, at.character()?) {
        (Expected::Name | Expected::Value, '\'' | '‘' | '’' | '“' | '”' | '„' | '«' | '»' | '`') => Some(
            diagnostic(at, "names and strings need straight double quotes")
                .help("write \" before and after the string"),
        ),
        (Expected::Colon, '=') => Some(
            diagnostic(at, "a colon separates name and value").help("write `:` for `=`").fix(at.character_span(), ":"),
        ),
        (Expected::Colon, _) => {
            let (name, _) = at.before()?;
            let end = Span { start: name.end, end: name.end };
            Some(
                Diagnostic::at(Code::JsonSyntax, end, "a colon is missing between name and value")
                    .help("write a colon after the name"),
            )
        }
        (Expected::Value, '+' | '.') | (Expected::Number, _) => number(at),
        (Expected::Name, _) => name(at),
        (Expected::Value | Expected::Comma, _) => value(at, expected),
        _ => None,
    }
}

fn diagnostic(at: &Place<'_>, message: &str) -> Diagnostic {
    Diagnostic::at(Code::JsonSyntax, at.character_span(), message)
}

/// A name without quotes.
fn name(at: &Place<'_>) -> Option<Diagnostic> {
    let (span, name) = at.word(is_word)?;
    let quoted = format!("\"{name}\"");
    Some(
        Diagnostic::at(Code::JsonSyntax, span, format!("`{name}` needs double quotes")).help(format!("write {quoted}")),
    )
}

/// A string without quotes, a literal of another language, a number with its unit.
fn value(at: &Place<'_>, expected: Expected) -> Option<Diagnostic> {
    let (span, word) = at.word(is_word)?;
    if expected == Expected::Comma && span.start == at.character_span().start {
        // It follows a whole value.
        let (_, '0'..='9') = at.before()? else { return None };
        return Some(Diagnostic::at(Code::JsonSyntax, span, "a number has no unit").help(format!("delete `{word}`")));
    }
    if word.starts_with(|c: char| c.is_ascii_digit()) {
        return number(at);
    }
    if matches!(word, "None" | "nil" | "NULL" | "Null" | "undefined" | "NaN" | "Infinity" | "True" | "False") {
        return Some(
            Diagnostic::at(Code::JsonSyntax, span, format!("JSON does not know `{word}`"))
                .help("its words are true, false and null; leave the element out if it has no value"),
        );
    }
    let after = at.rest().trim_start_matches(is_word).trim_start_matches([' ', '\t']);
    let is_one_word = after.starts_with([',', '}', ']', '\r', '\n']);
    let help = if is_one_word { format!("write \"{word}\"") } else { "put the whole string into double quotes".into() };
    Some(Diagnostic::at(Code::JsonSyntax, span, format!("`{word}` needs double quotes")).help(help))
}

/// A number with a unit, a leading zero, a plus, without digits on one side of its point.
fn number(at: &Place<'_>) -> Option<Diagnostic> {
    let (span, word) = at.word(|c| is_word(c) || matches!(c, '+' | '.'))?;
    Some(
        Diagnostic::at(Code::JsonSyntax, span, format!("`{word}` is not a number as JSON has it"))
            .help("write digits without leading zeros, plus or unit: 24, 0.5, 23.976"),
    )
}

fn is_word(c: char) -> bool {
    c.is_alphanumeric() || matches!(c, '_' | '-')
}
