//! The context of a position in a Lipz file, which may be incomplete JSON.

/// The context of a position.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) enum Context<'t> {
    /// Between elements, where a name may start.
    Between,
    /// A name, which starts at this byte, after its quote.
    Name(usize),
    /// The string value of the element with this name. It starts at this byte, after its quote.
    Text(&'t str, usize),
    /// Before the value of the element with this name.
    Value(&'t str),
    /// Between curves, where a name may start.
    BetweenCurves,
    /// The name of a curve, which starts at this byte, after its quote.
    CurveName(usize),
    /// Anything else.
    Other,
}

/// The state of the parser, apart from the string that it may be in.
#[derive(Default)]
struct State<'t> {
    /// The number of open braces and brackets.
    depth: usize,
    /// The name of the current element.
    name: Option<&'t str>,
    is_behind_colon: bool,
    has_value: bool,
    /// The last string in the element `curves`, and whether a colon follows it.
    curve: Option<&'t str>,
    is_behind_curve: bool,
    /// The names of all elements so far.
    names: Vec<&'t str>,
    /// The names of all curves so far.
    curves: Vec<&'t str>,
}

/// Returns the context at byte `at`. Only the text before it matters.
pub(crate) fn context(text: &str, at: usize) -> Context<'_> {
    match read(text.get(..at).unwrap_or(text)) {
        (state, Some(start)) => state.in_string(start),
        (state, None) => state.between(),
    }
}

/// Returns the names of the elements as spelled, even if the file is not valid JSON.
pub(crate) fn names(text: &str) -> Vec<&str> {
    read(text).0.names
}

/// Returns the names of the curves.
pub(crate) fn curve_names(text: &str) -> Vec<&str> {
    read(text).0.curves
}

/// Returns the state at the end of the text, and the start of the string that is open there.
fn read(text: &str) -> (State<'_>, Option<usize>) {
    let bytes = text.as_bytes();
    let mut state = State::default();
    let mut next = 0;
    while let Some(&byte) = bytes.get(next) {
        next += 1;
        if byte == b'"' {
            let Some(end) = end_of_string(bytes, next) else { return (state, Some(next)) };
            if state.depth == 1 && !state.is_behind_colon {
                state.name = text.get(next..end);
            }
            if state.is_in_curves() && !state.is_behind_curve {
                state.curve = text.get(next..end);
            }
            state.has_value |= state.is_behind_colon;
            next = end + usize::from(bytes.get(end) == Some(&b'"'));
        } else {
            state.read(byte);
        }
    }
    (state, None)
}

/// Returns the end of the string that starts at `from`: its quote, or the end of the line if the quote is missing;
/// `None` if the text ends before.
fn end_of_string(bytes: &[u8], from: usize) -> Option<usize> {
    let mut at = from;
    loop {
        match bytes.get(at)? {
            b'"' | b'\n' => return Some(at),
            b'\\' => at += 2,
            _ => at += 1,
        }
    }
}

impl<'t> State<'t> {
    fn read(&mut self, byte: u8) {
        match byte {
            b'{' => {
                self.depth += 1;
                (self.curve, self.is_behind_curve) = (None, false);
            }
            // A list at the root does not contain elements.
            b'[' => self.depth += if self.depth == 0 { 2 } else { 1 },
            b'}' | b']' => {
                self.depth = self.depth.saturating_sub(1);
                self.has_value = true;
            }
            b':' if self.depth == 1 => {
                self.names.extend(self.name.filter(|_| !self.is_behind_colon));
                self.is_behind_colon = true;
            }
            b':' if self.is_in_curves() => {
                self.curves.extend(self.curve.filter(|_| !self.is_behind_curve));
                self.is_behind_curve = true;
            }
            b',' if self.is_in_curves() => (self.curve, self.is_behind_curve) = (None, false),
            b',' if self.depth == 1 => (self.name, self.is_behind_colon, self.has_value) = (None, false, false),
            // If the comma is missing, a name may still start on the next line.
            b'\n' if self.depth == 1 && self.has_value => (self.name, self.is_behind_colon) = (None, false),
            b' ' | b'\t' | b'\r' | b'\n' => {}
            _ => self.has_value |= self.is_behind_colon,
        }
    }

    /// Whether the position is directly in the braces of `curves`.
    fn is_in_curves(&self) -> bool {
        self.depth == 2 && self.is_behind_colon && self.name == Some("curves")
    }

    fn in_string(&self, start: usize) -> Context<'t> {
        if self.is_in_curves() && !self.is_behind_curve {
            return Context::CurveName(start);
        }
        match (self.depth, self.is_behind_colon, self.name) {
            (1, true, Some(name)) => Context::Text(name, start),
            (1, false, _) => Context::Name(start),
            _ => Context::Other,
        }
    }

    fn between(&self) -> Context<'t> {
        if self.is_in_curves() && !self.is_behind_curve && self.curve.is_none() {
            return Context::BetweenCurves;
        }
        match (self.depth, self.is_behind_colon, self.name) {
            (1, true, Some(name)) if !self.has_value => Context::Value(name),
            (1, false, None) => Context::Between,
            _ => Context::Other,
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    /// Returns the context at `§`.
    fn at(text: &str) -> (Context<'static>, String) {
        let place = text.find('§').unwrap();
        let text: &'static str = text.replace('§', "").leak();
        let found = context(text, place);
        let start = match found {
            Context::Name(start) | Context::Text(_, start) | Context::CurveName(start) => start,
            _ => place,
        };
        (found, text[start..place].to_owned())
    }

    #[test]
    fn names_and_values() {
        assert_eq!(at("{§"), (Context::Between, String::new()));
        assert_eq!(at("{ \"vis§"), (Context::Name(3), "vis".into()));
        assert_eq!(at("{ \"fps\": §"), (Context::Value("fps"), String::new()));
        assert_eq!(at("{ \"fps\": 24§"), (Context::Other, String::new()));
        assert_eq!(at("{ \"fps\": 24, §"), (Context::Between, String::new()));
        assert_eq!(at("{ \"fps\": 24\n  \"te§"), (Context::Name(15), "te".into()), "a comma is missing");
        assert_eq!(at("{ \"events\": \"a|b§|c\" }"), (Context::Text("events", 13), "a|b".into()));
        assert_eq!(at("{ \"a\\\"b\": \"c\\\\\", \"§"), (Context::Name(18), String::new()));
        assert_eq!(at("{ \"events\": \"open\n \"x§"), (Context::Name(20), "x".into()), "a string ends with its line");
    }

    #[test]
    fn names_are_found_behind_mistakes() {
        assert_eq!(names("{ \"a\": 1, \"b\" \n\"c\": { \"d\": 2 }, \"e\": \":\", \"f\""), ["a", "c", "e"]);
    }

    #[test]
    fn curves_have_names() {
        assert_eq!(at("{ \"curves\": { \"an§\" }"), (Context::CurveName(15), "an".into()));
        assert_eq!(at("{ \"curves\": {§"), (Context::BetweenCurves, String::new()));
        assert_eq!(at("{ \"curves\": { \"joy\": \"0:1\", §"), (Context::BetweenCurves, String::new()));
        for text in [
            "{ \"curves\": { \"joy\": \"0§",
            "{ \"curves\": { \"joy\"§",
            "{ \"x\": { \"an§",
            "{ \"curves\": { \"a\": { \"b§",
        ] {
            assert_eq!(at(text).0, Context::Other, "{text}");
        }
        assert_eq!(
            curve_names("{ \"x\": { \"y\": 1 }, \"curves\": { \"joy\": \"0:1\", \"fear\" : \"\" "),
            ["joy", "fear"]
        );
    }

    #[test]
    fn what_is_not_of_the_format_is_something_else() {
        for text in ["§", "[§", "{}§", "{ \"x\": [\"a§", "{ \"fps\"§", "\"§"] {
            assert_eq!(at(text).0, Context::Other, "{text}");
        }
    }
}
