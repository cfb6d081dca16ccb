//! Reading on behind mistakes: all that is wrong with the syntax of a file, and the elements that can be read.
//!
//! Whole files never come here. Of a file that serde_json has refused, every token is looked at once; where one is not
//! what was expected, `syntax` says what was probably meant, and reading goes on behind it.

mod strings;
mod tokens;

use super::syntax::{self, Expected, Mistake, Place, Then};
use lipz_diagnostics::{Diagnostic, bound};
use std::ops::Range;
use strings::Read;

/// How often it may be unclear where reading goes on. After so many times, the file is something else.
const MOST_LOST: usize = 10;

/// A name or value, as it is in the text.
#[derive(Clone, Debug)]
pub(super) enum Literal<'s> {
    /// As JSON has it.
    Json(&'s str),
    /// A string whose quotes are missing, or none of JSON's.
    Bare(&'s str),
}

/// What was found in a file with mistakes.
#[derive(Debug)]
pub(super) struct Found<'s> {
    /// The elements of the root object that can be read.
    pub(super) members: Vec<(Literal<'s>, Literal<'s>)>,
    /// Whether these are all elements.
    pub(super) is_complete: bool,
}

/// Reads a text that is not JSON, and reports why.
pub(super) fn recover<'s>(text: &'s str, diagnostics: &mut Vec<Diagnostic>) -> Found<'s> {
    let mut scan = Scan {
        text,
        at: 0,
        read: 0,
        expected: Expected::Value,
        open: Vec::new(),
        is_first: false,
        name: None,
        value_start: 0,
        is_damaged: false,
        has_last: false,
        is_sure: true,
        lost: 0,
        found: Found { members: Vec::new(), is_complete: true },
        diagnostics,
    };
    scan.root();
    scan.found
}

/// What is open around a place.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Open {
    Object,
    Array,
}

struct Scan<'s, 'd> {
    text: &'s str,
    at: usize,
    /// Where what was read last ends, apart from white space and comments.
    read: usize,
    expected: Expected,
    open: Vec<Open>,
    /// Whether the innermost object or array has nothing yet.
    is_first: bool,
    /// The name of the element whose value is read, if it can be.
    name: Option<Literal<'s>>,
    /// Where this value starts, if it is an object or array, and whether something in it cannot be read.
    value_start: usize,
    is_damaged: bool,
    /// Whether the last element is among the members.
    has_last: bool,
    /// Whether it is beyond doubt what each character belongs to.
    is_sure: bool,
    /// How often it was unclear where reading goes on.
    lost: usize,
    found: Found<'s>,
    diagnostics: &'d mut Vec<Diagnostic>,
}

impl<'s> Scan<'s, '_> {
    /// Reads the root, and what stands around it.
    fn root(&mut self) {
        let has_comment = self.comments();
        if self.rest().starts_with('{') {
            self.open(Open::Object);
            while self.elements() && self.behind_root() {}
            return;
        }
        self.found.is_complete = false;
        if !has_comment {
            self.report(syntax::not_object(self.text));
        }
    }

    /// Skips white space and comments, and reports these; whether there were any.
    fn comments(&mut self) -> bool {
        let mut has_comment = false;
        loop {
            self.white_space();
            let Some(Mistake { diagnostic, then }) = syntax::comment(&self.place()) else {
                return has_comment;
            };
            has_comment = true;
            self.report(diagnostic);
            self.at = if let Then::Again(behind) = then { behind } else { self.text.len() };
        }
    }

    /// Reads what follows the root; whether it has more elements there.
    fn behind_root(&mut self) -> bool {
        self.comments();
        if self.rest().is_empty() || !self.is_sure {
            return false;
        }
        let Mistake { diagnostic, then } = syntax::explain_rest(&self.place());
        self.report(diagnostic);
        let goes_on = matches!(then, Then::Taken(_));
        if goes_on {
            self.open.push(Open::Object);
            self.expected = Expected::Comma;
        }
        self.found.is_complete &= goes_on;
        goes_on
    }

    /// Reads up to the end of the root; whether it has one.
    fn elements(&mut self) -> bool {
        loop {
            self.white_space();
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

    /// The file ends before its object does.
    fn end(&mut self) {
        self.found.is_complete = false;
        if self.is_sure {
            self.report(syntax::unfinished(self.text));
        }
    }

    /// Reports a mistake and goes where reading goes on; whether it does.
    fn mistake(&mut self, mistake: Mistake) -> bool {
        self.report(mistake.diagnostic);
        // The text of an object or array is kept whole: it is JSON, or nothing.
        self.is_damaged |= self.open.len() > 1;
        match mistake.then {
            Then::Again(at) => {
                self.at = at;
                return true;
            }
            Then::Taken(at) => {
                self.at = at;
                self.expected = match self.expected {
                    Expected::Colon => Expected::Value,
                    _ => self.behind_comma(),
                };
                self.is_first = false;
            }
            Then::Bare(content, behind) => {
                self.at = behind;
                self.bare(content);
            }
            Then::Damaged(at) => {
                self.at = at;
                self.damaged();
            }
            Then::Close => self.expected = Expected::Comma,
            Then::Lost(at) => return self.lost(at),
            Then::End => {
                self.found.is_complete = false;
                return false;
            }
        }
        self.read = self.at;
        true
    }

    fn place(&self) -> Place<'s> {
        Place::new(self.text, self.at, self.read)
    }

    /// What is expected behind a comma.
    fn behind_comma(&self) -> Expected {
        match self.open.last() {
            Some(Open::Array) => Expected::Value,
            _ => Expected::Name,
        }
    }

    /// Goes where the next element starts, if there is one.
    fn lost(&mut self, from: usize) -> bool {
        // What cannot be an element says nothing about the one before.
        self.has_last &= self.expected != Expected::Name;
        self.damaged();
        self.is_sure = false;
        self.lost += 1;
        let next = syntax::find_element(self.text, from).filter(|_| self.lost <= MOST_LOST);
        next.is_some_and(|next| self.resume(next))
    }

    /// Goes to the start of an element, or to a closing brace.
    fn resume(&mut self, at: usize) -> bool {
        self.at = at;
        while self.open.last() == Some(&Open::Array) {
            self.open.pop();
        }
        self.is_first = false;
        self.name = None;
        self.expected = if self.rest().starts_with('}') { Expected::Comma } else { Expected::Name };
        true
    }

    /// A name or a string without the quotes of JSON has been read.
    fn bare(&mut self, content: Range<usize>) {
        let literal = Literal::Bare(self.text.get(content).unwrap_or_default());
        if self.expected == Expected::Name { self.named(Some(literal)) } else { self.value(Some(literal)) }
    }

    /// The value that was read, or the one before, cannot be read.
    fn damaged(&mut self) {
        let is_behind = matches!(self.expected, Expected::Name | Expected::Comma);
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
        self.expected = Expected::Comma;
    }

    /// Reports a mistake. Where it is in doubt what belongs to what, no fix is certain.
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

    /// Pieces of which files are made, and those that people put where they do not belong.
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

        /// What serde_json refuses has a mistake here, and what it accepts has none.
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
