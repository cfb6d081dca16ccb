//! Units after numbers: `5 kg`, `20 °C`, `3 zł`. `data/numbers/units.txt` has their names from CLDR, and
//! `spoken-units.txt` has colloquial ones.

use super::plural;
use std::collections::HashMap;
use std::sync::LazyLock;

/// Symbols, each with the forms for the categories of numbers.
type Units = Vec<(&'static str, &'static str)>;

static UNITS: LazyLock<HashMap<&str, Units>> = LazyLock::new(|| {
    let mut units: HashMap<&str, Units> = HashMap::new();
    for file in
        [include_str!("../../../data/numbers/units.txt"), include_str!("../../../data/numbers/spoken-units.txt")]
    {
        let mut own = None;
        for line in file.lines().filter(|line| !line.starts_with('#')) {
            match line.strip_prefix('@') {
                Some(code) => own = Some(units.entry(code).or_default()),
                None => own.iter_mut().for_each(|own| own.extend(entries(line))),
            }
        }
    }
    units
});

/// Returns the entries of a line such as `kg кг one{# килограмм}…`.
fn entries(line: &'static str) -> impl Iterator<Item = (&'static str, &'static str)> {
    let head = line.get(..line.find('{').unwrap_or(0)).unwrap_or_default();
    let (symbols, forms) = line.split_at(head.rfind(' ').unwrap_or(0));
    symbols.split(' ').map(move |symbol| (symbol, forms))
}

/// Spaces between a number and its unit.
const BLANKS: [char; 4] = [' ', '\u{a0}', '\u{2009}', '\u{202f}'];
/// One-letter symbols that remain units after a space. Others are words there: `5 s bratrem`.
const AFTER_BLANK: [char; 9] = ['g', 'h', 'l', 'm', 't', 'г', 'л', 'м', 'т'];

/// Symbols that are common words after a space: `en 1990 mi padre`, `nel 1990 ha detto`.
const WORDS: [(&str, &str); 7] =
    [("es", "ha"), ("es", "mi"), ("it", "ha"), ("it", "mi"), ("ca", "ha"), ("ca", "mi"), ("pl", "mi")];

/// A unit in a text.
pub(super) struct MeasureUnit {
    /// The length in bytes, including the space before it.
    pub(super) length: usize,
    /// Whether it is a unit of degrees, whose name is often omitted.
    pub(super) is_of_degrees: bool,
    code: &'static str,
    forms: Vec<&'static str>,
}

/// Returns the unit at the start of a text, with or without a space before it, or `None` if the letters belong to a
/// word.
pub(super) fn find(code: &str, text: &str) -> Option<MeasureUnit> {
    let (code, units) = UNITS.get_key_value(code)?;
    let blank = text.chars().next().filter(|c| BLANKS.contains(c)).map_or(0, char::len_utf8);
    let rest = text.get(blank..)?;
    let ends = |symbol: &str| {
        let next = rest.get(symbol.len()..).and_then(|rest| rest.chars().next());
        !next
            .is_some_and(|c| c.is_alphanumeric() && !super::super::writing(c).stands_alone() || matches!(c, '\'' | '’'))
    };
    let is_word = |symbol: &str| {
        // `1945 г.` is a year.
        let is_year = symbol == "г" && rest[symbol.len()..].starts_with('.');
        let mut letters = symbol.chars();
        let only = letters.next().filter(|c| c.is_alphabetic() && letters.next().is_none());
        let is_other = only.is_some_and(|letter| !AFTER_BLANK.contains(&letter));
        blank > 0 && (is_year || is_other || WORDS.contains(&(*code, symbol)))
    };
    let fits = |symbol: &&str| rest.starts_with(symbol) && ends(symbol) && !is_word(symbol);
    let symbol = units.iter().map(|(symbol, _)| *symbol).filter(fits).max_by_key(|symbol| symbol.len())?;
    let forms = units.iter().filter(|(known, _)| *known == symbol).map(|(_, forms)| *forms).collect();
    Some(MeasureUnit {
        length: blank + symbol.len(), is_of_degrees: symbol.starts_with(['°', '℃', '℉']), code, forms
    })
}

impl MeasureUnit {
    /// Returns all names for this integer, or for a number with decimals. `#` stands for the number.
    pub(super) fn names(&self, number: Option<u64>) -> impl Iterator<Item = &'static str> {
        self.forms.iter().map(move |forms| match number {
            Some(number) => plural::choose(self.code, number, forms),
            None => plural::of_decimals(forms),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Language, Reliance};

    #[test]
    fn every_language_has_units_with_a_place_for_the_number() {
        for language in Language::all().filter(|language| language.reliance() != Reliance::Letters) {
            let units = UNITS.get(language.code()).map_or(&[][..], Vec::as_slice);
            assert!(units.len() > 30, "{language:?}");
            for (symbol, forms) in units {
                for number in [Some(1), Some(3), Some(5), Some(21), None] {
                    let unit =
                        MeasureUnit { length: 0, is_of_degrees: false, code: language.code(), forms: vec![forms] };
                    let names: Vec<&str> = unit.names(number).collect();
                    assert!(names.iter().all(|name| name.matches('#').count() == 1), "{symbol} {number:?} {names:?}");
                }
            }
        }
    }

    #[test]
    fn letters_of_words_are_no_units() {
        let length = |code, text| find(code, text).map(|unit| unit.length);
        assert_eq!(length("en", "kg of"), Some(2));
        assert_eq!(length("en", "\u{a0}km/h."), Some(6));
        assert_eq!(length("en", " m"), Some(2));
        assert_eq!(length("de", "kg-Sack"), Some(2));
        assert_eq!((length("ru", " г сахара"), length("it", "ha")), (Some(3), Some(2)));
        for (code, text) in [
            ("en", " men"),
            ("en", "D"),
            ("cs", " s bratrem"),
            ("ru", " с братом"),
            ("ru", " г. всё"),
            ("fr", " m'ont"),
            ("it", " ha detto"),
            ("es", " mi padre"),
            ("tlh", "kg"),
        ] {
            assert_eq!(length(code, text), None, "{code} {text}");
        }
        assert_eq!(length("cs", "s"), Some(1));
        assert_eq!(length("ja", "kgの"), Some(2));
    }
}
