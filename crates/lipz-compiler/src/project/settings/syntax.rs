//! Diagnostics for a file that is not valid TOML.

use lipz_diagnostics::{Code, Diagnostic, Span, escape};
use std::collections::BTreeMap;
use toml::de::{DeTable, DeValue, Error};

/// The parser's message for unclosed brackets, at the end of the text that they include.
const UNCLOSED: &str = "unclosed";

/// The errors of the parser. It continues after each error as well as it can.
pub(super) struct Faults<'t> {
    text: &'t str,
    line_starts: Vec<usize>,
    /// The first error of each line. Later ones result from it.
    by_line: BTreeMap<usize, &'t Error>,
    /// An unclosed bracket, from which all other errors result.
    unclosed: Option<&'t Error>,
}

impl<'t> Faults<'t> {
    /// Creates the faults of `text`, in which the parser found `errors`.
    pub(super) fn new(text: &'t str, errors: &'t [Error]) -> Faults<'t> {
        let line_starts = text.match_indices('\n').map(|(end, _)| end + 1).collect();
        let unclosed = errors.iter().find(|error| error.message().starts_with(UNCLOSED));
        let mut faults = Faults { text, line_starts, by_line: BTreeMap::new(), unclosed };
        for error in errors {
            let line = faults.line(error.span().map_or(0, |span| span.start));
            faults.by_line.entry(line).or_insert(error);
        }
        faults
    }

    /// Returns the diagnostics. `root` is the parser's result.
    pub(super) fn diagnostics(&self, root: &DeTable<'_>) -> Vec<Diagnostic> {
        match self.unclosed {
            Some(error) => vec![diagnostic(self.text, root, error)],
            None => self.by_line.values().map(|error| diagnostic(self.text, root, error)).collect(),
        }
    }

    /// Whether the parser may have guessed the content at `place`.
    pub(super) fn may_have_made_up(&self, place: Span) -> bool {
        let lines = self.line(place.start as usize)..=self.line(place.end as usize);
        self.unclosed.is_some() || self.by_line.range(lines).next().is_some()
    }

    /// Returns the number of line ends before byte `at`.
    fn line(&self, at: usize) -> usize {
        self.line_starts.partition_point(|&start| start <= at)
    }
}

fn diagnostic(text: &str, root: &DeTable<'_>, error: &Error) -> Diagnostic {
    let place = error.span().unwrap_or_default();
    let written = text.get(place.clone()).unwrap_or_default();
    let message = error.message();
    let (what, _) = message.split_once(", expected").unwrap_or((message, ""));
    let at = |message: String| Diagnostic::at(Code::SettingsSyntax, Span::new(place.start, place.end), message);
    match what {
        "string values must be quoted" if written.is_empty() => {
            at("a value is missing".to_owned()).help("write a value after the `=`, or remove the line")
        }
        "string values must be quoted" => at(format!("{} is a string without quotes", escape::quoted(written)))
            .help(format!("write \"{}\"", escape::text(written))),
        "duplicate key" => {
            at(format!("{} appears twice", escape::quoted(written))).help("merge the two, or remove one")
        }
        "missing escaped value" => {
            at("`\\` does not start an escape".to_owned()).help("write `/` in paths on every system")
        }
        "invalid boolean" => {
            at(format!("{} is neither true nor false", escape::quoted(written))).help("write true or false")
        }
        "key with no value" => at("a name has no value".to_owned()).help("write name = value, as in default-fps = 24"),
        "invalid basic string" => {
            at("a string is not closed".to_owned()).help("put strings between \" and \" on one line")
        }
        "unexpected key or value" => {
            at("the line continues after a value".to_owned()).help("put lists in […], and each setting on its own line")
        }
        "unclosed array" => match opening(root, place.start) {
            Some(start) => Diagnostic::at(Code::SettingsSyntax, Span::new(start, start + 1), "this `[` has no `]`")
                .help("close the list: [\"…\", \"…\"]"),
            None => at("a list is not closed".to_owned()).help("close the list: [\"…\", \"…\"]"),
        },
        "missing comma between array elements" => {
            at("a `,` is missing before this item of the list".to_owned()).help("write [\"…\", \"…\"]")
        }
        "unclosed table" => at("the name of a table has no `]`".to_owned())
            .help("close the name, as in [text]; put quotes around a name with spaces: [babble.\"old robot\"]"),
        _ => at(format!("this is not TOML: {}", escape::text(message)))
            .help("put strings in \"…\", lists in […], and each setting on its own line"),
    }
}

/// Returns the start of the array that the parser ended at byte `end`.
fn opening(table: &DeTable<'_>, end: usize) -> Option<usize> {
    table.iter().find_map(|(_, value)| match value.get_ref() {
        DeValue::Array(_) if value.span().end == end => Some(value.span().start),
        DeValue::Table(table) => opening(table, end),
        _ => None,
    })
}
