//! Applies fixes: a source text and its replacements → the new text.

use crate::{Applicability, Fix, Span};

/// The result of [`Fix::apply_all`].
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub struct FixedText {
    /// The new text.
    pub text: String,
    /// The indices of the applied fixes in the list.
    pub applied: Vec<usize>,
}

impl Fix {
    /// Returns a certain change that replaces `span` by `replacement`.
    pub fn new(span: Span, replacement: impl Into<String>) -> Fix {
        Fix { span, replacement: replacement.into(), applicability: Applicability::MachineApplicable }
    }

    /// Whether it certainly matches the author's intent, so that tools may apply it without asking.
    pub fn is_certain(&self) -> bool {
        self.applicability == Applicability::MachineApplicable
    }

    /// Applies `fixes` to the text that their spans refer to. If fixes overlap, only the one that starts first is
    /// applied. A fix that reaches outside the text, or into a character, is skipped.
    ///
    /// ```
    /// use lipz_diagnostics::{Fix, Span};
    /// let quotes = Fix::new(Span::new(8, 12), "24");
    /// let comma = Fix::new(Span::new(12, 13), "");
    /// assert_eq!(Fix::apply_all(r#"{"fps": "24",}"#, &[&comma]).text, r#"{"fps": "24"}"#);
    /// assert_eq!(Fix::apply_all(r#"{"fps": "24",}"#, &[&comma, &quotes]).text, r#"{"fps": 24}"#);
    /// ```
    pub fn apply_all(text: &str, fixes: &[&Fix]) -> FixedText {
        let mut order: Vec<usize> = (0..fixes.len()).collect();
        order.sort_by_key(|&index| fixes.get(index).map(|fix| fix.span));
        let mut fixed = FixedText { text: String::with_capacity(text.len()), applied: Vec::with_capacity(fixes.len()) };
        let mut done = 0;
        for index in order {
            let Some(fix) = fixes.get(index) else { continue };
            let range = fix.span.range();
            // `get` also returns `None` if the range overlaps the last fix.
            if let (Some(kept), Some(_)) = (text.get(done..range.start), text.get(range.clone())) {
                fixed.text.push_str(kept);
                fixed.text.push_str(&fix.replacement);
                fixed.applied.push(index);
                done = range.end;
            }
        }
        fixed.text.push_str(text.get(done..).unwrap_or_default());
        fixed
    }
}

/// The fixes of many diagnostics, without the rest of these: 12 bytes each, and the replacement.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub(crate) struct Fixes {
    /// The replaced part, and the end of its replacement in `replacements`.
    spans: Vec<(Span, u32)>,
    replacements: String,
}

impl Fixes {
    /// Adds a fix, unless there are 4 GiB of replacements.
    pub(crate) fn push(&mut self, fix: &Fix) {
        if let Ok(end) = u32::try_from(self.replacements.len() + fix.replacement.len()) {
            self.replacements.push_str(&fix.replacement);
            self.spans.push((fix.span, end));
        }
    }

    /// Returns the fixes in the order in which they were added.
    pub(crate) fn iter(&self) -> impl ExactSizeIterator<Item = Fix> {
        let mut start = 0;
        self.spans.iter().map(move |&(span, end)| {
            let replacement = self.replacements.get(start..end as usize).unwrap_or_default();
            start = end as usize;
            Fix::new(span, replacement)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fixed(text: &str, fixes: &[(usize, usize, &str)]) -> (String, Vec<usize>) {
        let fixes: Vec<Fix> =
            fixes.iter().map(|&(start, end, replacement)| Fix::new(Span::new(start, end), replacement)).collect();
        let fixed = Fix::apply_all(text, &fixes.iter().collect::<Vec<_>>());
        (fixed.text, fixed.applied)
    }

    #[test]
    fn fixes_in_any_order() {
        assert_eq!(fixed("abc", &[]), ("abc".into(), vec![]));
        assert_eq!(fixed("abcdef", &[(4, 5, "E"), (0, 1, "AA"), (2, 4, "")]), ("AAbEf".into(), vec![1, 2, 0]));
        assert_eq!(fixed("ab", &[(0, 0, "<"), (2, 2, ">"), (1, 1, "|")]), ("<a|b>".into(), vec![0, 2, 1]));
    }

    #[test]
    fn the_first_of_two_that_overlap() {
        assert_eq!(fixed("abcdef", &[(2, 5, "x"), (1, 3, "y")]), ("aydef".into(), vec![1]));
        assert_eq!(fixed("abc", &[(0, 3, "x"), (1, 1, "y")]), ("x".into(), vec![0]));
        assert_eq!(fixed("abc", &[(0, 0, ""), (0, 3, "x")]), ("x".into(), vec![0, 1]));
    }

    #[test]
    fn spans_that_are_no_part_of_the_text() {
        assert_eq!(fixed("aü", &[(2, 3, "x"), (9, 12, "y"), (1, 9, "z")]), ("aü".into(), vec![]));
    }
}
