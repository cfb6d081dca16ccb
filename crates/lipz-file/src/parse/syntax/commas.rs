//! Errors with commas: one too many, one too few, one in a number.

use super::error_position::{ErrorPosition, WHITE_SPACE, starts_bare_element, starts_element};
use super::{Continuation, ExpectedToken, Mistake};
use lipz_diagnostics::{Code, Diagnostic, Span};

/// The most digits of a number that a message repeats.
const DIGITS_SHOWN: usize = 24;

/// The rates of film and video that are not whole numbers, as people write them: before and after the point.
const KNOWN_RATES: [(&str, &str); 8] = [
    ("14", "985"),
    ("23", "976"),
    ("23", "98"),
    ("29", "97"),
    ("47", "952"),
    ("47", "95"),
    ("59", "94"),
    ("119", "88"),
];

pub(super) fn explain(at: &ErrorPosition<'_>, expected: ExpectedToken) -> Option<Mistake> {
    trailing(at, expected)
        .or_else(|| too_many(at, expected))
        .or_else(|| decimal(at, expected))
        .or_else(|| missing(at, expected))
}

/// A comma before a closing brace or bracket.
fn trailing(at: &ErrorPosition<'_>, expected: ExpectedToken) -> Option<Mistake> {
    if !matches!(expected, ExpectedToken::Name | ExpectedToken::Value) || !matches!(at.character()?, '}' | ']') {
        return None;
    }
    let (comma, ',') = at.before()? else { return None };
    Some(
        Continuation::Close.after(
            Diagnostic::at(Code::TrailingComma, comma, "a comma follows the last element")
                .help("delete the comma; JSON allows commas only between elements")
                .fix(comma, ""),
        ),
    )
}

/// A comma after a comma, or before the first element.
fn too_many(at: &ErrorPosition<'_>, expected: ExpectedToken) -> Option<Mistake> {
    if !matches!(expected, ExpectedToken::Name | ExpectedToken::Value) || at.character()? != ',' {
        return None;
    }
    let (_, ',' | '{' | '[') = at.before()? else { return None };
    let span = at.character_span();
    let diagnostic = Diagnostic::at(Code::JsonSyntax, span, "one comma too many").help("delete this comma");
    Some(Continuation::Again(at.offset() + 1).after(diagnostic.fix(span, "")))
}

/// A number with a comma, `23,976`. The part after the comma looks like a name.
fn decimal(at: &ErrorPosition<'_>, expected: ExpectedToken) -> Option<Mistake> {
    let (start, rest) = (at.start().strip_suffix(',')?, at.rest());
    let is_digit = |c: char| c.is_ascii_digit();
    let whole = start.get(start.trim_end_matches(is_digit).len()..)?;
    let fraction = rest.get(..rest.len() - rest.trim_start_matches(is_digit).len())?;
    if expected != ExpectedToken::Name || whole.is_empty() || fraction.is_empty() {
        return None;
    }
    let (comma, _) = at.before()?;
    let message = match whole.len() + fraction.len() {
        ..=DIGITS_SHOWN => format!("`{whole},{fraction}` has a decimal comma"),
        _ => "the number has a decimal comma".to_owned(),
    };
    let diagnostic = Diagnostic::at(Code::JsonSyntax, comma, message)
        .help("replace this comma with a point, or delete the part that does not belong to the number");
    // `3,0` may be a typing error for 30, `1,000` may be a thousand, and other elements may contain anything.
    let is_fps = start
        .strip_suffix(whole)?
        .trim_end_matches(WHITE_SPACE)
        .strip_suffix(':')
        .is_some_and(|before| before.trim_end_matches(WHITE_SPACE).ends_with("\"fps\""));
    let is_known = KNOWN_RATES.contains(&(whole, fraction));
    Some(Continuation::Damaged(at.offset() + fraction.len()).after(match is_fps && is_known {
        true => diagnostic.help("replace this comma with a point").fix(comma, "."),
        false => diagnostic,
    }))
}

/// A missing comma between a value and the next element.
fn missing(at: &ErrorPosition<'_>, expected: ExpectedToken) -> Option<Mistake> {
    let (value, last) = at.before()?;
    if expected != ExpectedToken::Comma {
        return None;
    }
    let value_ended = matches!(last, '"' | '}' | ']' | 'e' | 'l' | '0'..='9');
    let is_next_to_it = value.end == at.character_span().start;
    let starts_element = starts_element(at.rest());
    let is_next_line = at.text_of(Span { start: value.end, end: at.character_span().start })?.contains('\n');
    let is_name = at.character()? == '"' && value_ended && (last != '"' || !is_next_to_it || starts_element);
    let is_bare = is_next_line && starts_bare_element(at.rest());
    if !is_name && !is_bare {
        return None; // a quotation mark inside a text, or something else
    }
    let end = Span { start: value.end, end: value.end };
    let diagnostic = Diagnostic::at(Code::JsonSyntax, end, "a comma is missing between two elements")
        .also(at.character_span(), "the next element starts here")
        .help("write a comma after the value");
    let then =
        if starts_element || is_next_line { Continuation::Taken(at.offset()) } else { Continuation::Lost(at.offset()) };
    // In one line, the quotation mark may also be one of a text: "the "Admiral": a parrot".
    Some(then.after(if is_next_line && value_ended && starts_element { diagnostic.fix(end, ",") } else { diagnostic }))
}
