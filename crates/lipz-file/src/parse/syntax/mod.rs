//! What is wrong with text that is not JSON, in words that help whoever wrote it, and where reading goes on.
//!
//! The modules look at the characters around a place for the mistakes that people make.

mod commas;
mod place;
mod root;
mod strings;
mod words;

pub(super) use place::{Place, WHITE_SPACE, find_element, starts_element};
pub(super) use root::{explain_rest, not_object, unfinished};
pub(super) use strings::{control_character, escape, half_of_a_pair};

use lipz_diagnostics::{Code, Diagnostic};
use std::ops::Range;

/// What would have been read instead of what is there.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Expected {
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
    /// Another character of `true`, `false` or `null`.
    Word,
}

/// A mistake.
pub(super) struct Mistake {
    /// What is wrong.
    pub(super) diagnostic: Diagnostic,
    /// How reading goes on.
    pub(super) then: Then,
}

/// How reading goes on behind a mistake, from a byte of the file.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) enum Then {
    /// The same is expected there: something was in front of it.
    Again(usize),
    /// As if what was expected had been there.
    Taken(usize),
    /// The same, with a name or a string that is as good as one in quotes.
    Bare(Range<usize>, usize),
    /// Behind a value that cannot be read.
    Damaged(usize),
    /// At the closing brace or bracket, without another element.
    Close,
    /// Where the next element starts, somewhere behind this place.
    Lost(usize),
    /// Not at all.
    End,
}

impl Then {
    fn after(self, diagnostic: Diagnostic) -> Mistake {
        Mistake { diagnostic, then: self }
    }
}

/// Explains why what stands at a place is not what was expected.
pub(super) fn explain(at: &Place<'_>, expected: Expected) -> Mistake {
    comment(at)
        .or_else(|| commas::explain(at, expected))
        .or_else(|| strings::quotation_mark(at, expected))
        .or_else(|| words::explain(at, expected))
        .unwrap_or_else(|| other(at, expected))
}

pub(super) fn comment(at: &Place<'_>) -> Option<Mistake> {
    let rest = at.rest();
    let length = if rest.starts_with("//") || rest.starts_with('#') {
        Some(rest.lines().next()?.len())
    } else if rest.starts_with("/*") {
        rest.find("*/").map(|end| end + 2)
    } else {
        return None;
    };
    let span = at.span_of(length.unwrap_or(2));
    let then = length.map_or(Then::End, |length| Then::Again(at.offset() + length));
    Some(then.after(Diagnostic::at(Code::Comment, span, "JSON has no comments").help("delete the comment")))
}

/// An unusual mistake.
fn other(at: &Place<'_>, expected: Expected) -> Mistake {
    let example = "a Lipz file looks like { \"visemes\": \"MAEO-\", \"text_en-us\": \"Hello\" }";
    let (message, help) = match expected {
        Expected::Name => ("an element starts with its name in double quotes", example),
        Expected::Value | Expected::Word => ("a value is missing here", "write the value, or delete the element"),
        Expected::Comma => ("a comma or a closing brace is missing here", example),
        Expected::Colon | Expected::Number => ("this is not JSON", example),
    };
    let then = match (expected, at.character()) {
        (Expected::Comma, Some(';')) => Then::Taken(at.offset() + 1),
        (Expected::Value, Some(',' | '}' | ']')) => Then::Damaged(at.offset()),
        // A bracket that closes something else, or nothing.
        (_, Some('}' | ']')) => Then::End,
        _ => Then::Lost(at.offset()),
    };
    then.after(Diagnostic::at(Code::JsonSyntax, at.character_span(), message).help(help))
}
