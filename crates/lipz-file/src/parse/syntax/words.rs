//! Words without quotes, with other quotes, numbers that are none, other signs for the colon.

use super::Expected;
use super::place::{Place, WHITE_SPACE};
use lipz_diagnostics::{Code, Diagnostic, Span, escape};

pub(super) fn explain(at: &Place<'_>, expected: Expected) -> Option<Diagnostic> {
    if let Some(diagnostic) = white_space(at, expected) {
        return Some(diagnostic);
    }
    match (expected, at.character()?) {
        (Expected::Value, '−' | '–' | '—') => {
            let shown = at.character().map(escape::numbered).unwrap_or_default();
            Some(diagnostic(at, format!("{shown} is not the minus of JSON")).help("delete it, or write `-`"))
        }
        (Expected::Comma, '/') => fraction(at),
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

fn diagnostic(at: &Place<'_>, message: impl Into<String>) -> Diagnostic {
    Diagnostic::at(Code::JsonSyntax, at.character_span(), message)
}

/// White space that JSON does not have, and characters without any shape: they look like nothing at all.
fn white_space(at: &Place<'_>, expected: Expected) -> Option<Diagnostic> {
    let character = at.character()?;
    if WHITE_SPACE.contains(&character) || character.is_control() || escape::has_shape(character) {
        return None;
    }
    let message = format!("{} is not white space as JSON has it", escape::code_point(character));
    let diagnostic = diagnostic(at, message).help("delete it, or write a space");
    // Behind a value it may be a part of a text, whose quotes are wrong.
    let is_between = matches!(expected, Expected::Name | Expected::Value | Expected::Colon);
    Some(if is_between { diagnostic.fix(at.character_span(), " ") } else { diagnostic })
}

/// A fraction, `24000/1001`: as a decimal number, if it is that of a frame rate.
fn fraction(at: &Place<'_>) -> Option<Diagnostic> {
    let is_digit = |c: char| c.is_ascii_digit();
    let start = at.start().trim_end_matches(WHITE_SPACE);
    let above = start.get(start.trim_end_matches(is_digit).len()..)?;
    let below = at.rest().strip_prefix('/')?.trim_start_matches(WHITE_SPACE);
    let below = below.get(..below.len() - below.trim_start_matches(is_digit).len())?;
    let (numerator, denominator): (u32, u32) = (above.parse().ok()?, below.parse().ok()?);
    let begin = start.len() - above.len();
    let end = below.as_ptr() as usize + below.len() - at.start().as_ptr() as usize;
    let message = format!("JSON has no fractions: `{numerator}/{denominator}`");
    let diagnostic = Diagnostic::at(Code::JsonSyntax, Span::new(begin, end), message);
    Some(match denominator {
        0 => diagnostic.help("write a decimal number: 23.976"),
        _ => {
            diagnostic.help(format!("write it as a decimal number: {}", f64::from(numerator) / f64::from(denominator)))
        }
    })
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
    if word.chars().all(char::is_numeric) {
        let diagnostic = Diagnostic::at(Code::JsonSyntax, span, format!("`{word}` are not the digits of JSON"));
        return Some(diagnostic.help(match digits(word) {
            Some(digits) => format!("write {digits}"),
            None => "write the digits 0 to 9".to_owned(),
        }));
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

/// The number in the digits 0 to 9, if it is written in those of a script that people type on a keyboard.
fn digits(word: &str) -> Option<String> {
    // Where the digit 0 is: ASCII, Arabic, Persian, Devanagari, Bengali, Thai, full width.
    const ZEROS: [char; 7] = ['0', '٠', '۰', '०', '০', '๐', '０'];
    let digit = |c: char| {
        let values = ZEROS.iter().filter_map(|&zero| u32::from(c).checked_sub(u32::from(zero)));
        values.min().and_then(|value| char::from_digit(value, 10))
    };
    word.chars().map(digit).collect()
}

fn is_word(c: char) -> bool {
    c.is_alphanumeric() || matches!(c, '_' | '-')
}
