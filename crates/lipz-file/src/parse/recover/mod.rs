//! Parses beyond errors: finds all syntax errors of a file, and its readable elements.
//!
//! Valid files never come here. If serde_json has rejected a file, every token is read once. If it is unexpected,
//! `syntax` returns its probable meaning, and parsing continues after it.

mod conflict;
mod strings;
mod tokens;

use super::syntax::{self, Continuation, ErrorPosition, ExpectedToken, Mistake};
use lipz_diagnostics::{Diagnostic, bound};
use std::ops::Range;
use strings::StringOutcome;

/// How often the point to continue may be unclear. Beyond this limit, the file is probably something else.
const MOST_LOST: usize = 10;

/// A name or value as in the text.
#[derive(Clone, Debug)]
pub(super) enum Literal<'s> {
    /// As valid in JSON.
    Json(&'s str),
    /// A string without quotes, or with quotes that are not valid in JSON.
    Bare(&'s str),
}

/// The result for a file with errors.
#[derive(Debug)]
pub(super) struct RecoveredMembers<'s> {
    /// The readable elements of the root object.
    pub(super) members: Vec<(Literal<'s>, Literal<'s>)>,
    /// Whether these are all elements.
    pub(super) is_complete: bool,
}

/// Parses a text that is not JSON, and reports why.
pub(super) fn recover<'s>(text: &'s str, diagnostics: &mut Vec<Diagnostic>) -> RecoveredMembers<'s> {
    let mut scan = Scan {
        text,
        at: 0,
        read: 0,
        expected: ExpectedToken::Value,
        open: Vec::new(),
        is_first: false,
        name: None,
        value_start: 0,
        is_damaged: false,
        has_last: false,
        is_sure: true,
        is_in_conflict: false,
        lost: 0,
        found: RecoveredMembers { members: Vec::new(), is_complete: true },
        diagnostics,
    };
    scan.root();
    scan.found
}

/// The open brackets around a position.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Container {
    Object,
    Array,
}

struct Scan<'s, 'd> {
    text: &'s str,
    at: usize,
    /// The end of the last token, before whitespace and comments.
    read: usize,
    expected: ExpectedToken,
    open: Vec<Container>,
    /// Whether the innermost object or array is still empty.
    is_first: bool,
    /// The name of the element whose value is being read, if it is readable.
    name: Option<Literal<'s>>,
    /// The start of this value, if it is an object or array, and whether part of it is unreadable.
    value_start: usize,
    is_damaged: bool,
    /// Whether the last element is among the members.
    has_last: bool,
    /// Whether the role of each character is certain.
    is_sure: bool,
    /// Whether the position is in the first version of a conflict.
    is_in_conflict: bool,
    /// How often the point to continue was unclear.
    lost: usize,
    found: RecoveredMembers<'s>,
    diagnostics: &'d mut Vec<Diagnostic>,
}

impl<'s> Scan<'s, '_> {
    /// Parses the root, and the text around it.
    fn root(&mut self) {
        let has_comment = self.comments();
        if self.rest().starts_with('{') {
            self.open(Container::Object);
            while self.elements() && self.behind_root() {}
            return;
        }
        self.found.is_complete = false;
        if !has_comment {
            self.report(syntax::not_object(self.text));
        }
    }

    /// Skips whitespace, comments and markers of conflicts, and reports them. Returns whether there were comments.
    fn comments(&mut self) -> bool {
        let mut has_comment = false;
        loop {
            self.white_space();
            if self.conflict_marker() {
                continue;
            }
            let Some(Mistake { diagnostic, then }) = syntax::comment(&self.place()) else {
                return has_comment;
            };
            has_comment = true;
            self.report(diagnostic);
            self.at = if let Continuation::Again(behind) = then { behind } else { self.text.len() };
        }
    }

    /// Parses the text after the root. Returns whether it continues the root's elements.
    fn behind_root(&mut self) -> bool {
        self.comments();
        if self.rest().is_empty() || !self.is_sure {
            return false;
        }
        let Mistake { diagnostic, then } = syntax::explain_rest(&self.place());
        self.report(diagnostic);
        let goes_on = matches!(then, Continuation::Taken(_));
        if goes_on {
            self.open.push(Container::Object);
            self.expected = ExpectedToken::Comma;
        }
        self.found.is_complete &= goes_on;
        goes_on
    }

    /// Parses up to the end of the root. Returns whether there is one.
    fn elements(&mut self) -> bool {
        loop {
            self.white_space();
            if self.conflict_marker() {
                continue;
            }
            let goes_on = match self.token() {
                Some(goes_on) => goes_on,
                None if self.rest().is_empty() => {
                    self.end();
                    false
                }
                None => self.mistake(syntax::explain(&self.place(), self.expected)),
            };
            if !goes_on {
                return false;
            }
            if self.open.is_empty() {
                return true;
            }
        }
    }

    /// Reports that the file ends before its object does.
    fn end(&mut self) {
        self.found.is_complete = false;
        if self.is_sure {
            self.report(syntax::unfinished(self.text));
        }
    }

    /// Reports an error and moves to the point to continue. Returns whether there is one.
    fn mistake(&mut self, mistake: Mistake) -> bool {
        self.report(mistake.diagnostic);
        // The text of an object or array is kept as a whole, and only if it is JSON.
        self.is_damaged |= self.open.len() > 1;
        match mistake.then {
            Continuation::Again(at) => {
                self.at = at;
                return true;
            }
            Continuation::Taken(at) => {
                self.at = at;
                self.expected = match self.expected {
                    ExpectedToken::Colon => ExpectedToken::Value,
                    _ => self.behind_comma(),
                };
                self.is_first = false;
            }
            Continuation::Bare(content, behind) => {
                self.at = behind;
                self.bare(content);
            }
            Continuation::Damaged(at) => {
                self.at = at;
                self.damaged();
            }
            Continuation::Close => self.expected = ExpectedToken::Comma,
            Continuation::Lost(at) => return self.lost(at),
            Continuation::End => {
                self.found.is_complete = false;
                return false;
            }
        }
        self.read = self.at;
        true
    }

    fn place(&self) -> ErrorPosition<'s> {
        ErrorPosition::new(self.text, self.at, self.read)
    }

    /// Returns what is expected after a comma.
    fn behind_comma(&self) -> ExpectedToken {
        match self.open.last() {
            Some(Container::Array) => ExpectedToken::Value,
            _ => ExpectedToken::Name,
        }
    }

    /// Moves to the start of the next element, if there is one.
    fn lost(&mut self, from: usize) -> bool {
        // If this cannot be an element, the one before it is unaffected.
        self.has_last &= self.expected != ExpectedToken::Name;
        self.damaged();
        self.is_sure = false;
        self.lost += 1;
        let next = syntax::find_element(self.text, from).filter(|_| self.lost <= MOST_LOST);
        next.is_some_and(|next| self.resume(next))
    }

    /// Moves to the start of an element, or to a closing brace.
    fn resume(&mut self, at: usize) -> bool {
        self.at = at;
        while self.open.last() == Some(&Container::Array) {
            self.open.pop();
        }
        self.is_first = false;
        self.name = None;
        self.expected = if self.rest().starts_with('}') { ExpectedToken::Comma } else { ExpectedToken::Name };
        true
    }

    /// Records a name or a string without the quotes of JSON.
    fn bare(&mut self, content: Range<usize>) {
        let literal = Literal::Bare(self.text.get(content).unwrap_or_default());
        if self.expected == ExpectedToken::Name { self.named(Some(literal)) } else { self.value(Some(literal)) }
    }

    /// Records that the value just read, or the one before, is unreadable.
    fn damaged(&mut self) {
        let is_behind = matches!(self.expected, ExpectedToken::Name | ExpectedToken::Comma);
        if self.open.len() > 1 {
            self.is_damaged = true;
        } else if is_behind && self.has_last {
            self.found.members.pop();
        }
        if self.open.len() <= 1 {
            self.found.is_complete = false;
            self.has_last = false;
            self.name = None;
        }
        self.is_first = false;
        self.expected = ExpectedToken::Comma;
    }

    /// Reports an error. While the structure is uncertain, its fix is removed.
    fn report(&mut self, mut diagnostic: Diagnostic) {
        if !self.is_sure {
            diagnostic.fix = None;
        }
        self.diagnostics.push(diagnostic);
        bound::limit_many(self.diagnostics);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use serde_core::de::IgnoredAny;

    /// Parts of valid files, and parts that people put in the wrong place.
    const PIECES: [&str; 40] = [
        "{",
        "}",
        "[",
        "]",
        ",",
        ",",
        ":",
        "\"",
        "\"a\":",
        "\"b\":",
        "\"text_en-us\":",
        "'",
        "“",
        "”",
        "\\",
        "\\n",
        "\\u00e9",
        "\\u12",
        "\n",
        "\r\n",
        "\t",
        " ",
        "\u{a0}",
        "//",
        "/*",
        "*/",
        "#",
        "0",
        "24",
        ".5",
        "-",
        "−",
        "e",
        "/",
        "=",
        ";",
        "true",
        "null",
        "word",
        "é",
    ];

    fn pieces() -> impl Strategy<Value = String> {
        let piece = prop::sample::select(&PIECES[..]);
        let around = prop::sample::select(vec![("", ""), ("{", "}"), ("{\"a\":", "}"), ("{\"a\":1,", "}")]);
        (around, prop::collection::vec(piece, 0..30))
            .prop_map(|((open, close), all)| format!("{open}{}{close}", all.concat()))
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4_000))]

        /// The parser reports an error exactly if serde_json does.
        #[test]
        fn what_is_refused_is_what_serde_json_refuses(text in pieces()) {
            let is_object = text.trim_start_matches(syntax::WHITE_SPACE).starts_with('{');
            let is_accepted = is_object && serde_json::from_str::<IgnoredAny>(&text).is_ok();
            let mut diagnostics = Vec::new();
            let found = recover(&text, &mut diagnostics);
            prop_assert_eq!(diagnostics.is_empty(), is_accepted, "{:?} in {}", diagnostics, text);
            prop_assert!(!is_accepted || found.is_complete);
            for diagnostic in &diagnostics {
                let labels = diagnostic.primary.iter().chain(&diagnostic.labels).map(|label| label.span);
                for span in labels.chain(diagnostic.fix.iter().map(|fix| fix.span)) {
                    prop_assert!(text.get(span.range()).is_some(), "{:?} in {}", diagnostic, text);
                }
            }
        }
    }
}
