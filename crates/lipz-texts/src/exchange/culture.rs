//! The English names of cultures in .NET, by which Unity finds the columns of a table.

use super::tag::bcp47;

/// A line per culture: its name, a tab, and its English name. The first line is a comment.
const NAMES: &str = include_str!("../../data/culture_names.tsv");

/// Returns the English name of a locale's culture, `German (Germany)` for `de-de`; `None` if .NET does not know it.
pub(crate) fn english_name(locale: &str) -> Option<&'static str> {
    let tag = bcp47(locale);
    NAMES.lines().filter_map(|line| line.split_once('\t')).find(|(name, _)| *name == tag).map(|(_, name)| name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_those_of_mono() {
        let names = ["de-de", "de", "zh-hans", "pt-br", "qaa"].map(english_name);
        let expected =
            [Some("German (Germany)"), Some("German"), Some("Chinese (Simplified)"), Some("Portuguese (Brazil)"), None];
        assert_eq!(names, expected);
    }
}
