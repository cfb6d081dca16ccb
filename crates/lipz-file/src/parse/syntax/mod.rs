//! What is wrong with text that is not JSON, in words that help whoever wrote it.
//!
//! serde_json tells where it stopped and what it expected; the modules look at the characters around
//! that place for the mistakes that people make.

mod commas;
mod place;
mod root;
mod strings;
mod words;

pub(super) use root::explain_rest;
pub(super) use strings::half_of_a_pair;

use lipz_diagnostics::{Code, Diagnostic};
use place::Place;
use serde_json::error::Category;

/// What serde_json would have read instead of what is there.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Expected {
    /// The name of an element.
    Name,
    /// A value.
    Value,
    /// The colon between them.
    Colon,
    /// A comma or a closing brace or bracket.
    Comma,
    /// Another character of a number.
    Number,
    /// Something else.
    Other,
}

/// Explains why the root object could not be read.
pub(super) fn explain(text: &str, error: &serde_json::Error) -> Diagnostic {
    let at = Place::new(text, error);
    if !root::is_object(text) {
        return comment(&at).unwrap_or_else(|| root::not_object(text));
    }
    if error.classify() == Category::Eof {
        return root::unfinished(text);
    }
    let message = error.to_string();
    // These two are inside of a string, where nothing else is to be looked for.
    if message.starts_with("control character") {
        return strings::control_character(&at.next());
    }
    if message.starts_with("invalid escape") {
        return strings::escape(&at).unwrap_or_else(|| other(&at, Expected::Other));
    }
    let expected = expected(&message);
    comment(&at)
        .or_else(|| commas::explain(&at, expected))
        .or_else(|| strings::quotation_mark(&at, expected))
        .or_else(|| words::explain(&at, expected))
        .unwrap_or_else(|| other(&at, expected))
}

fn expected(message: &str) -> Expected {
    match message {
        message if message.starts_with("key must be a string") => Expected::Name,
        message if message.starts_with("expected value") || message.starts_with("expected ident") => Expected::Value,
        message if message.starts_with("expected `:`") => Expected::Colon,
        message if message.starts_with("expected `,`") => Expected::Comma,
        message if message.starts_with("invalid number") || message.starts_with("number out") => Expected::Number,
        _ => Expected::Other,
    }
}

fn comment(at: &Place<'_>) -> Option<Diagnostic> {
    let rest = at.rest();
    let length = if rest.starts_with("//") || rest.starts_with('#') {
        rest.lines().next()?.len()
    } else if rest.starts_with("/*") {
        rest.find("*/").map_or(2, |end| end + 2)
    } else {
        return None;
    };
    Some(Diagnostic::at(Code::Comment, at.span_of(length), "JSON has no comments").help("delete the comment"))
}

/// An unusual mistake.
fn other(at: &Place<'_>, expected: Expected) -> Diagnostic {
    let example = "a Lipz file looks like { \"visemes\": \"MAEO-\", \"text_en-us\": \"Hello\" }";
    let (message, help) = match expected {
        Expected::Name => ("an element starts with its name in double quotes", example),
        Expected::Value => ("a value is missing here", "write the value, or delete the element"),
        Expected::Comma => ("a comma or a closing brace is missing here", example),
        Expected::Colon | Expected::Number | Expected::Other => ("this is not JSON", example),
    };
    Diagnostic::at(Code::JsonSyntax, at.character_span(), message).help(help)
}
