//! Patterns of a project's own placeholders, which games replace in texts.

use std::fmt::{self, Display, Formatter};
use std::ops::Range;
use std::str::FromStr;

/// The wildcard.
const ANY: char = '*';

/// A pattern of placeholders: `[item:*]`, `#*#`, `@*`, `\n`.
///
/// `*` stands for one or more characters before the text behind it. At the end of the pattern, `*` stands for letters,
/// digits and `_`.
///
/// ```
/// use lipz_file::placeholder::PlaceholderPattern;
/// let pattern: PlaceholderPattern = "[item:*]".parse()?;
/// let text = "Take [item:lamp oil] or [item:rope].";
/// let found: Vec<&str> = pattern.find(text).filter_map(|place| text.get(place)).collect();
/// assert_eq!(found, ["[item:lamp oil]", "[item:rope]"]);
/// # Ok::<(), lipz_file::placeholder::PatternError>(())
/// ```
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct PlaceholderPattern {
    /// The text before `*`, or all.
    start: String,
    /// The text behind `*`; `None` without one.
    end: Option<String>,
}

/// The reason why a pattern of placeholders is refused.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum PatternError {
    /// It has no text before `*`, or no text at all, so that it would match everywhere.
    NoStart,
    /// It has more than one `*`.
    TwoWildcards,
}

impl Display for PatternError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            PatternError::NoStart => "the pattern has no text before `*`",
            PatternError::TwoWildcards => "the pattern has more than one `*`",
        })
    }
}

impl std::error::Error for PatternError {}

impl FromStr for PlaceholderPattern {
    type Err = PatternError;

    fn from_str(pattern: &str) -> Result<PlaceholderPattern, PatternError> {
        let (start, end) = pattern.split_once(ANY).map_or((pattern, None), |(start, end)| (start, Some(end)));
        if start.trim().is_empty() {
            return Err(PatternError::NoStart);
        }
        if end.is_some_and(|end| end.contains(ANY)) {
            return Err(PatternError::TwoWildcards);
        }
        Ok(PlaceholderPattern { start: start.to_owned(), end: end.map(str::to_owned) })
    }
}

impl PlaceholderPattern {
    /// Returns the places of the placeholders in a text, in bytes and in order. They do not overlap.
    pub fn find<'t>(&'t self, text: &'t str) -> impl Iterator<Item = Range<usize>> + 't {
        let mut from = 0;
        std::iter::from_fn(move || {
            loop {
                let start = from + text.get(from..)?.find(&self.start)?;
                from = start + self.start.len();
                let rest = text.get(from..)?;
                if let Some(length) = self.length(rest) {
                    from += length;
                    return Some(start..from);
                }
                // No later one ends either.
                if self.end.as_ref().is_some_and(|end| !end.is_empty() && !rest.contains(end)) {
                    return None;
                }
            }
        })
    }

    /// Returns the number of bytes that belong to the placeholder behind its start.
    fn length(&self, rest: &str) -> Option<usize> {
        let Some(end) = &self.end else { return Some(0) };
        if end.is_empty() {
            let is_word = |character: char| character.is_alphanumeric() || character == '_';
            return Some(rest.find(|character| !is_word(character)).unwrap_or(rest.len())).filter(|length| *length > 0);
        }
        let first = rest.chars().next()?.len_utf8();
        rest.get(first..)?.find(end.as_str()).map(|at| first + at + end.len())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn placeholders_are_found_in_order() {
        for (pattern, text, expected) in [
            ("[item:*]", "[item:a][item:b] [item:", vec!["[item:a]", "[item:b]"]),
            ("#*#", "#a# and #b#", vec!["#a#", "#b#"]),
            ("#*#", "## no #", vec!["## no #"]),
            ("@*", "@amy, @ bob@otto_2.", vec!["@amy", "@otto_2"]),
            ("\\n", "one\\ntwo\\n", vec!["\\n", "\\n"]),
            ("«*»", "«ä»»", vec!["«ä»"]),
        ] {
            let parsed: PlaceholderPattern = pattern.parse().unwrap();
            assert_eq!(parsed.find(text).map(|place| &text[place]).collect::<Vec<_>>(), expected, "{pattern}");
        }
    }

    /// Each start of a long text has no end.
    #[test]
    fn texts_without_ends_take_linear_time() {
        let parsed: PlaceholderPattern = "[*]".parse().unwrap();
        assert_eq!(parsed.find(&"[".repeat(4 << 20)).count(), 0);
    }

    #[test]
    fn patterns_that_match_everywhere_are_refused() {
        for (pattern, error) in
            [("", PatternError::NoStart), (" *x", PatternError::NoStart), ("a*b*", PatternError::TwoWildcards)]
        {
            assert_eq!(pattern.parse::<PlaceholderPattern>(), Err(error));
        }
    }
}
