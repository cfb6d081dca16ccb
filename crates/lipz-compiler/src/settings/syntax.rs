//! What is wrong with a file that is not TOML.

use lipz_diagnostics::{Code, Diagnostic, Span, escape};
use std::collections::BTreeMap;
use toml::de::{DeTable, DeValue, Error};

/// What the parser says of brackets without partner, at the end of what they swallowed.
const UNCLOSED: &str = "unclosed";

/// What the parser stumbled over. It goes on after each error as best it can.
pub(super) struct Faults<'t> {
    text: &'t str,
    line_starts: Vec<usize>,
    /// The first error of each line: those after it come of it.
    by_line: BTreeMap<usize, &'t Error>,
    /// A bracket without partner: everything else comes of it.
    unclosed: Option<&'t Error>,
}

impl<'t> Faults<'t> {
    /// The faults of `text`, in which the parser found `errors`.
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

    /// The diagnostics; `root` is what the parser made of the text.
    pub(super) fn diagnostics(&self, root: &DeTable<'_>) -> Vec<Diagnostic> {
        match self.unclosed {
            Some(error) => vec![diagnostic(self.text, root, error)],
            None => self.by_line.values().map(|error| diagnostic(self.text, root, error)).collect(),
        }
    }

    /// Whether the parser may have made up what stands at `place`.
    pub(super) fn may_have_made_up(&self, place: Span) -> bool {
        let lines = self.line(place.start as usize)..=self.line(place.end as usize);
        self.unclosed.is_some() || self.by_line.range(lines).next().is_some()
    }

    /// The number of line ends before byte `at`.
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
        "string values must be quoted" => at(format!("{} is a text without quotes", escape::quoted(written)))
            .help(format!("write \"{}\"", escape::text(written))),
        "duplicate key" => at(format!("{} appears twice", escape::quoted(written))).help("join the two, or remove one"),
        "missing escaped value" => {
            at("`\\` starts an escape, and none follows".to_owned()).help("write `/` in paths, on every system")
        }
        "invalid boolean" => {
            at(format!("{} is neither true nor false", escape::quoted(written))).help("write true or false")
        }
        "key with no value" => at("a name has no value".to_owned()).help("write name = value, as in default-fps = 24"),
        "invalid basic string" => at("a text does not end".to_owned()).help("put texts between \" and \" on one line"),
        "unexpected key or value" => at("the line continues after a value".to_owned())
            .help("put lists in […], and each setting on a line of its own"),
        "unclosed array" => match opening(root, place.start) {
            Some(start) => Diagnostic::at(Code::SettingsSyntax, Span::new(start, start + 1), "this `[` has no `]`")
                .help("close the list: [\"…\", \"…\"]"),
            None => at("a list does not end".to_owned()).help("close the list: [\"…\", \"…\"]"),
        },
        "missing comma between array elements" => {
            at("a `,` is missing before this item of the list".to_owned()).help("write [\"…\", \"…\"]")
        }
        "unclosed table" => at("the name of a table has no `]`".to_owned())
            .help("write [text], for example, and quotes around a name with spaces: [babble.\"old robot\"]"),
        _ => at(format!("this is not TOML: {}", escape::text(message)))
            .help("put texts in \"…\", lists in […], and each setting on a line of its own"),
    }
}

/// Where the array starts that the parser ended at byte `end`.
fn opening(table: &DeTable<'_>, end: usize) -> Option<usize> {
    table.iter().find_map(|(_, value)| match value.get_ref() {
        DeValue::Array(_) if value.span().end == end => Some(value.span().start),
        DeValue::Table(table) => opening(table, end),
        _ => None,
    })
}
