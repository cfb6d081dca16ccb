//! Commas: one too many, one too few, one in a number.

use super::place::{Place, WHITE_SPACE, starts_bare_element, starts_element};
use super::{Expected, Mistake, Then};
use lipz_diagnostics::{Code, Diagnostic, Span};

/// Digits of the longest number that a message repeats.
const DIGITS_SHOWN: usize = 24;

/// The rates of film and video that are not whole numbers, as people write them: before and behind the point.
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

pub(super) fn explain(at: &Place<'_>, expected: Expected) -> Option<Mistake> {
    trailing(at, expected)
        .or_else(|| too_many(at, expected))
        .or_else(|| decimal(at, expected))
        .or_else(|| missing(at, expected))
}

/// A comma before a closing brace or bracket.
fn trailing(at: &Place<'_>, expected: Expected) -> Option<Mistake> {
    if !matches!(expected, Expected::Name | Expected::Value) || !matches!(at.character()?, '}' | ']') {
        return None;
    }
    let (comma, ',') = at.before()? else { return None };
    Some(
        Then::Close.after(
            Diagnostic::at(Code::TrailingComma, comma, "a comma follows the last element")
                .help("delete the comma: JSON has commas only between elements")
                .fix(comma, ""),
        ),
    )
}

/// A comma after a comma, or before the first element.
fn too_many(at: &Place<'_>, expected: Expected) -> Option<Mistake> {
    if !matches!(expected, Expected::Name | Expected::Value) || at.character()? != ',' {
        return None;
    }
    let (_, ',' | '{' | '[') = at.before()? else { return None };
    let span = at.character_span();
    let diagnostic = Diagnostic::at(Code::JsonSyntax, span, "one comma too many").help("delete this comma");
    Some(Then::Again(at.offset() + 1).after(diagnostic.fix(span, "")))
}

/// A number with a comma, `23,976`: what follows the comma is taken for a name.
fn decimal(at: &Place<'_>, expected: Expected) -> Option<Mistake> {
    let (start, rest) = (at.start().strip_suffix(',')?, at.rest());
    let is_digit = |c: char| c.is_ascii_digit();
    let whole = start.get(start.trim_end_matches(is_digit).len()..)?;
    let fraction = rest.get(..rest.len() - rest.trim_start_matches(is_digit).len())?;
    if expected != Expected::Name || whole.is_empty() || fraction.is_empty() {
        return None;
    }
    let (comma, _) = at.before()?;
    let message = match whole.len() + fraction.len() {
        ..=DIGITS_SHOWN => format!("a decimal number has a point: {whole}.{fraction}"),
        _ => "a decimal number has a point".to_owned(),
    };
    let diagnostic = Diagnostic::at(Code::JsonSyntax, comma, message)
        .help("write a point instead of this comma, or delete what does not belong to the number");
    // `3,0` may be 30 and a slip, `1,000` a thousand, and other elements may hold anything.
    let is_fps = start
        .strip_suffix(whole)?
        .trim_end_matches(WHITE_SPACE)
        .strip_suffix(':')
        .is_some_and(|before| before.trim_end_matches(WHITE_SPACE).ends_with("\"fps\""));
    let is_known = KNOWN_RATES.contains(&(whole, fraction));
    Some(Then::Damaged(at.offset() + fraction.len()).after(match is_fps && is_known {
        true => diagnostic.help("write a point instead of this comma").fix(comma, "."),
        false => diagnostic,
    }))
}

/// No comma between a value and the next element.
fn missing(at: &Place<'_>, expected: Expected) -> Option<Mistake> {
    let (value, last) = at.before()?;
    if expected != Expected::Comma {
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
    let then = if starts_element || is_next_line { Then::Taken(at.offset()) } else { Then::Lost(at.offset()) };
    // In one line, the quotation mark may also be one of a text: "the "Admiral": a parrot".
    Some(then.after(if is_next_line && value_ended && starts_element { diagnostic.fix(end, ",") } else { diagnostic }))
}
