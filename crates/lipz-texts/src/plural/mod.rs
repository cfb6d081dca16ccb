//! Plural categories of languages (Unicode CLDR, "Language Plural Rules"), and the plural forms of gettext.

mod expression;
mod forms;

pub(crate) use forms::PluralForms;

use icu_locale_core::Locale;
use icu_plurals::{PluralCategory, PluralRules};
use lipz_file::locale::language;
use std::collections::HashMap;
use std::sync::{Arc, LazyLock, Mutex, PoisonError};

/// The largest number whose category counts. Rules repeat every hundred. The exception are millions in a few languages, for
/// which gettext's forms and most translators have no form.
const LARGEST: u32 = 200;

/// The categories of the whole numbers in a language, in the order of CLDR. The text of a locale is the last one; the
/// others are keys of variants.
#[derive(Clone, Debug)]
pub(crate) struct Categories {
    /// Their names, as in the keys of variants: `one`, `few`.
    names: Vec<&'static str>,
    /// For each number up to [`LARGEST`], the index of its category.
    of_numbers: Vec<usize>,
}

/// The categories in the order of CLDR, with their names.
const ALL: [(PluralCategory, &str); 6] = [
    (PluralCategory::Zero, "zero"),
    (PluralCategory::One, "one"),
    (PluralCategory::Two, "two"),
    (PluralCategory::Few, "few"),
    (PluralCategory::Many, "many"),
    (PluralCategory::Other, "other"),
];

impl Categories {
    /// Returns the categories of the language of a locale. A language that CLDR does not know has one.
    pub(crate) fn of(locale: &str) -> Arc<Categories> {
        // Projects have few locales, and the rules of each take as long as checking a clip.
        static KNOWN: LazyLock<Mutex<HashMap<String, Arc<Categories>>>> = LazyLock::new(Mutex::default);
        let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(categories) = known.get(locale) {
            return Arc::clone(categories);
        }
        let categories = Arc::new(Categories::from_rules(locale));
        known.insert(locale.to_owned(), Arc::clone(&categories));
        categories
    }

    fn from_rules(locale: &str) -> Categories {
        let whole: Option<Locale> = locale.parse().ok().or_else(|| language(locale).parse().ok());
        let rules = whole.and_then(|locale| PluralRules::try_new(locale.into(), Default::default()).ok());
        let category = |number| rules.as_ref().map_or(PluralCategory::Other, |rules| rules.category_for(number));
        let of_numbers: Vec<PluralCategory> = (0..=LARGEST).map(category).collect();
        let used: Vec<_> = ALL.into_iter().filter(|(category, _)| of_numbers.contains(category)).collect();
        let index = |category: &PluralCategory| used.iter().position(|(used, _)| used == category).unwrap_or(0);
        Categories {
            of_numbers: of_numbers.iter().map(index).collect(),
            names: used.into_iter().map(|(_, name)| name).collect(),
        }
    }

    /// Returns the names of the categories that need a variant: all but the last, in order.
    pub(crate) fn variants(&self) -> &[&'static str] {
        self.names.split_last().map_or(&[], |(_, others)| others)
    }

    /// Whether a category has a single number, as `one` in English, but not in Russian, where it includes 21.
    pub(crate) fn has_one_number(&self, name: &str) -> bool {
        let index = self.names.iter().position(|known| *known == name);
        index.is_some_and(|index| self.of_numbers.iter().filter(|category| **category == index).count() == 1)
    }
}

/// Joins a plural category and the rest of a key, each of which may be empty: `few-fem`.
pub(crate) fn join_category(category: &str, rest: &str) -> String {
    let names = [category, rest].into_iter().filter(|name| !name.is_empty());
    names.collect::<Vec<_>>().join("-")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn categories_are_those_of_whole_numbers() {
        let of = |locale: &str| Categories::of(locale).names.join(" ");
        assert_eq!(of("en-us"), "one other");
        assert_eq!(of("pl-pl"), "one few many", "`other` is for fractions");
        assert_eq!(of("ar-eg"), "zero one two few many other");
        assert_eq!(of("fr-fr"), "one other", "`many` is for millions");
        assert_eq!(of("ja-jp"), "other");
        assert_eq!(of("qq-xx"), "other");
        assert_eq!(of("pt-br"), "one other");
        assert_eq!(Categories::of("ru-ru").variants(), ["one", "few"]);
        assert!(Categories::of("ja-jp").variants().is_empty());
        assert!(Categories::of("en-us").has_one_number("one") && !Categories::of("ru-ru").has_one_number("one"));
    }
}
