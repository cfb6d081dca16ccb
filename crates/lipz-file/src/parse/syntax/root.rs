//! The file around its one object: something else, an end too early or too late.

use super::place::{Place, WHITE_SPACE};
use super::{Mistake, Then};
use lipz_diagnostics::{Code, Diagnostic, Span};

const ONE_OBJECT: &str = "a Lipz file is one object: { \"visemes\": \"…\", \"text_en-us\": \"…\" }";

/// The file is another JSON value, or no JSON at all.
pub(in crate::parse) fn not_object(text: &str) -> Diagnostic {
    let root = text.trim_start_matches(WHITE_SPACE);
    let start = text.len() - root.len();
    let span = Span::new(start, start + root.chars().next().map_or(0, char::len_utf8));
    let found = match root.as_bytes().first() {
        Some(b'[') => "an array",
        Some(b'"') => "a string",
        Some(b'-' | b'0'..=b'9') => "a number",
        _ => match root.trim_end_matches(WHITE_SPACE) {
            "null" => "null",
            "true" | "false" => "a boolean",
            _ => return Diagnostic::at(Code::JsonSyntax, span, "the file does not start with `{`").help(ONE_OBJECT),
        },
    };
    Diagnostic::at(Code::RootNotObject, span, format!("the root is {found}, not an object")).help(ONE_OBJECT)
}

/// The file ends inside of something: a string, or the object.
pub(in crate::parse) fn unfinished(text: &str) -> Diagnostic {
    let end = text.trim_end_matches(WHITE_SPACE).len();
    Diagnostic::at(Code::UnfinishedFile, Span::new(end, end), "the file ends before its object does")
        .label("something is missing from here on")
        .help("is a closing `\"` or `}` missing, or was the file cut off while it was copied?")
}

/// Explains what follows the root object. [`Then::Taken`] is where its elements go on.
pub(in crate::parse) fn explain_rest(at: &Place<'_>) -> Mistake {
    let diagnostic = |message| Diagnostic::at(Code::JoinedObjects, at.character_span(), message);
    let after_comma = at.rest().trim_start_matches([',', ' ', '\t', '\r', '\n']);
    let (diagnostic, then) = match (at.character(), after_comma.chars().next(), at.before()) {
        (_, Some('{'), _) => (
            diagnostic("a second object follows the first")
                .label("the clip's object has ended before this")
                .note("one Lipz file describes one audio file")
                .help("put each object into a file of its own"),
            Then::End,
        ),
        (Some('}'), ..) => {
            let diagnostic = diagnostic("one closing brace too many").help("delete this `}`");
            let is_last = at.rest().trim_end_matches(WHITE_SPACE).len() == 1;
            (if is_last { diagnostic.fix(at.character_span(), "") } else { diagnostic }, Then::End)
        }
        (Some(','), Some('"'), Some((brace, _))) => (
            Diagnostic::at(Code::JoinedObjects, brace, "the object is closed too early")
                .also(at.character_span(), "more elements follow")
                .help("delete this `}`"),
            Then::Taken(at.offset()),
        ),
        _ => (
            diagnostic("text follows the closing brace of the root object")
                .help("delete everything after the last `}`; if it belongs to the clip, move it inside"),
            Then::End,
        ),
    };
    then.after(diagnostic)
}
