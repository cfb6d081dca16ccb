//! Explains syntax errors in the words of an author, and decides where to continue.
//!
//! The modules check the characters around a position for common errors.

mod commas;
mod error_position;
mod root;
mod strings;
mod words;

pub(super) use error_position::{ErrorPosition, WHITE_SPACE, find_element, starts_element};
pub(super) use root::{explain_rest, not_object, unfinished};
pub(super) use strings::{control_character, escape, half_of_a_pair};

use lipz_diagnostics::{Code, Diagnostic};
use std::ops::Range;

/// The expected token.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum ExpectedToken {
    /// The name of an element.
    Name,
    /// A value.
    Value,
    /// The colon between them.
    Colon,
    /// A comma or a closing brace or bracket.
    Comma,
    /// The next character of a number.
    Number,
    /// The next character of `true`, `false` or `null`.
    Word,
}

/// An error.
pub(super) struct Mistake {
    /// The description of the error.
    pub(super) diagnostic: Diagnostic,
    /// How to continue.
    pub(super) then: Continuation,
}

/// How to continue after an error, from a byte of the file.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) enum Continuation {
    /// Expect the same token there: something came before it.
    Again(usize),
    /// Continue as if the expected token had been there.
    Taken(usize),
    /// The same, with a name or a string that is as good as a quoted one.
    Bare(Range<usize>, usize),
    /// Continue after a value that is unreadable.
    Damaged(usize),
    /// Continue at the closing brace or bracket, without another element.
    Close,
    /// Continue at the start of the next element, somewhere after this position.
    Lost(usize),
    /// Stop.
    End,
}

impl Continuation {
    fn after(self, diagnostic: Diagnostic) -> Mistake {
        Mistake { diagnostic, then: self }
    }
}

/// Explains why the text at a position is unexpected.
pub(super) fn explain(at: &ErrorPosition<'_>, expected: ExpectedToken) -> Mistake {
    comment(at)
        .or_else(|| commas::explain(at, expected))
        .or_else(|| strings::quotation_mark(at, expected))
        .or_else(|| words::explain(at, expected))
        .unwrap_or_else(|| other(at, expected))
}

pub(super) fn comment(at: &ErrorPosition<'_>) -> Option<Mistake> {
    let rest = at.rest();
    let length = if rest.starts_with("//") || rest.starts_with('#') {
        Some(rest.lines().next()?.len())
    } else if rest.starts_with("/*") {
        rest.find("*/").map(|end| end + 2)
    } else {
        return None;
    };
    let span = at.span_of(length.unwrap_or(2));
    let then = length.map_or(Continuation::End, |length| Continuation::Again(at.offset() + length));
    Some(then.after(Diagnostic::at(Code::Comment, span, "JSON has no comments").help("delete the comment")))
}

/// An uncommon error.
fn other(at: &ErrorPosition<'_>, expected: ExpectedToken) -> Mistake {
    let example = "a Lipz file looks like { \"visemes\": \"MAEO-\", \"text_en-us\": \"Hello\" }";
    let (message, help) = match expected {
        ExpectedToken::Name => ("an element starts with its name in double quotes", example),
        ExpectedToken::Value | ExpectedToken::Word => {
            ("a value is missing here", "write the value, or delete the element")
        }
        ExpectedToken::Comma => ("a comma or a closing brace is missing here", example),
        ExpectedToken::Colon | ExpectedToken::Number => ("this is not JSON", example),
    };
    let then = match (expected, at.character()) {
        (ExpectedToken::Comma, Some(';')) => Continuation::Taken(at.offset() + 1),
        (ExpectedToken::Value, Some(',' | '}' | ']')) => Continuation::Damaged(at.offset()),
        // The bracket closes something else, or nothing.
        (_, Some('}' | ']')) => Continuation::End,
        _ => Continuation::Lost(at.offset()),
    };
    then.after(Diagnostic::at(Code::JsonSyntax, at.character_span(), message).help(help))
}
