//! Lines and columns of all diagnostics of a file, found in one pass, because a file on a single line may have many
//! thousands of diagnostics.

use crate::Label;
use crate::Report;
use crate::escape;
use crate::{Diagnostic, LineColumn, Span};
use std::collections::HashMap;

/// Line and column of each byte offset in the diagnostics of a report.
pub(crate) struct Places(HashMap<u32, LineColumn>);

impl Places {
    pub(crate) fn new(report: &Report) -> Places {
        let spans = report.diagnostics.iter().flat_map(spans);
        let mut offsets: Vec<u32> = spans.flat_map(|span| [span.start, span.end]).collect();
        offsets.sort_unstable();
        offsets.dedup();

        let text = report.source.text.as_str();
        let mut place = LineColumn { line: 1, column: 1 };
        let mut done = 0;
        let place_of = |offset: u32| {
            let end = text.floor_char_boundary(offset as usize);
            for c in text[done..end].chars() {
                match c {
                    '\n' => place = LineColumn { line: place.line + 1, column: 1 },
                    _ => place.column += 1,
                }
            }
            done = end;
            (offset, place)
        };
        Places(offsets.into_iter().map(place_of).collect())
    }

    /// Returns the start and the end of a span of these diagnostics.
    pub(crate) fn ends(&self, span: Span) -> [LineColumn; 2] {
        let unnamed = LineColumn { line: 1, column: 1 };
        [span.start, span.end].map(|offset| self.0.get(&offset).copied().unwrap_or(unnamed))
    }

    /// Returns the position of a diagnostic, as far as it is known, to print before its message:
    /// `voices/mayor.lipz:3:16: `.
    pub(crate) fn prefix(&self, path: &str, diagnostic: &Diagnostic) -> String {
        let path = escape::text(path);
        match &diagnostic.primary {
            _ if path.is_empty() => String::new(),
            None => format!("{path}: "),
            Some(label) => {
                let [place, _] = self.ends(label.span);
                format!("{path}:{}:{}: ", place.line, place.column)
            }
        }
    }
}

/// Returns every span of a diagnostic.
fn spans(diagnostic: &Diagnostic) -> impl Iterator<Item = Span> {
    let labels = diagnostic.primary.iter().chain(&diagnostic.labels).map(|label: &Label| label.span);
    labels.chain(diagnostic.fix.iter().map(|fix| fix.span))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Code, Source};

    #[test]
    fn they_are_those_of_the_source() {
        let source = Source { path: String::new(), text: "{ \"é\": 1,\n\r\n \"灯台😀\": 2 }".into() };
        let end = u32::try_from(source.text.len()).unwrap_or_default();
        let mut report = Report { source, diagnostics: Vec::new() };
        // Also inside characters, past the end, and out of order.
        for start in (0..end + 3).rev() {
            let span = Span { start, end: end + 3 - start };
            report.diagnostics.push(Diagnostic::at(Code::UnknownElement, span, "x"));
        }
        let places = Places::new(&report);
        for diagnostic in &report.diagnostics {
            for span in spans(diagnostic) {
                let expected = [span.start, span.end].map(|offset| report.source.line_column(offset));
                assert_eq!(places.ends(span), expected, "{span:?}");
            }
        }
    }
}
