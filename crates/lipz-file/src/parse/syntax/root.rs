//! The file around its object: different content, or an end too early or too late.

use super::error_position::{ErrorPosition, WHITE_SPACE};
use super::{Continuation, Mistake};
use lipz_diagnostics::{Code, Diagnostic, Span};

const ONE_OBJECT: &str = "a Lipz file is one object: { \"visemes\": \"…\", \"text_en-us\": \"…\" }";

/// The file contains a different JSON value, or is not JSON.
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

/// The file ends inside a string or the object.
pub(in crate::parse) fn unfinished(text: &str) -> Diagnostic {
    let end = text.trim_end_matches(WHITE_SPACE).len();
    Diagnostic::at(Code::UnfinishedFile, Span::new(end, end), "the file ends before its object is closed")
        .label("something is missing from here on")
        .help("add the missing `\"` or `}`, or copy the file again if it was cut off")
}

/// Explains the text after the root object. [`Continuation`](super::Continuation) is where its elements continue.
pub(in crate::parse) fn explain_rest(at: &ErrorPosition<'_>) -> Mistake {
    let diagnostic = |message| Diagnostic::at(Code::JoinedObjects, at.character_span(), message);
    let after_comma = at.rest().trim_start_matches([',', ' ', '\t', '\r', '\n']);
    let (diagnostic, then) = match (at.character(), after_comma.chars().next(), at.before()) {
        (_, Some('{'), _) => (
            diagnostic("a second object follows the first")
                .label("the clip's object ends before this")
                .note("one Lipz file describes one audio file")
                .help("put each object into its own file"),
            Continuation::End,
        ),
        (Some('}'), ..) => {
            let diagnostic = diagnostic("one closing brace too many").help("delete this `}`");
            let is_last = at.rest().trim_end_matches(WHITE_SPACE).len() == 1;
            (if is_last { diagnostic.fix(at.character_span(), "") } else { diagnostic }, Continuation::End)
        }
        (Some(','), Some('"'), Some((brace, _))) => (
            Diagnostic::at(Code::JoinedObjects, brace, "the object is closed too early")
                .also(at.character_span(), "more elements follow")
                .help("delete this `}`"),
            Continuation::Taken(at.offset()),
        ),
        _ => (
            diagnostic("text follows the closing brace of the root object")
                .help("delete everything after the last `}`; if it belongs to the clip, move it inside"),
            Continuation::End,
        ),
    };
    then.after(diagnostic)
}
