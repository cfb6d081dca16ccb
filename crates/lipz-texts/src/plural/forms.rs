//! The plural forms of a PO file: which text of an entry is for which plural category.

use super::Categories;
use super::expression::Expression;

/// The expressions of gettext's manual and of CLDR's rules, each for many languages, with the number of forms. The
/// first one that gives every number the category of a language is the language's.
const KNOWN: [(usize, &str); 19] = [
    (1, "0"),
    (2, "(n != 1)"),
    (2, "(n > 1)"),
    (2, "(n%10!=1 || n%100==11)"),
    (2, "(n%10==4 || n%10==6 || n%10==9)"),
    (2, "(n!=0 && n!=1 && (n<11 || n>99))"),
    (3, "(n==1 ? 0 : n==2 ? 1 : 2)"),
    (3, "(n==1 ? 0 : n>=2 && n<=4 ? 1 : 2)"),
    (3, "(n==1 ? 0 : n==0 || n%100>0 && n%100<20 ? 1 : 2)"),
    (3, "(n==1 ? 0 : n%10>=2 && n%10<=4 && (n%100<12 || n%100>14) ? 1 : 2)"),
    (3, "(n%10==1 && n%100!=11 ? 0 : n%10>=2 && n%10<=4 && (n%100<12 || n%100>14) ? 1 : 2)"),
    (3, "(n%10==1 && (n%100<11 || n%100>19) ? 0 : n%10>=2 && (n%100<11 || n%100>19) ? 1 : 2)"),
    (3, "(n%10==0 || n%100>=11 && n%100<=19 ? 0 : n%10==1 && n%100!=11 ? 1 : 2)"),
    (4, "(n%100==1 ? 0 : n%100==2 ? 1 : n%100==3 || n%100==4 ? 2 : 3)"),
    (4, "(n==1 || n==11 ? 0 : n==2 || n==12 ? 1 : n>2 && n<20 ? 2 : 3)"),
    (5, "(n==1 ? 0 : n==2 ? 1 : n>2 && n<7 ? 2 : n>6 && n<11 ? 3 : 4)"),
    (5, "(n==1 ? 0 : n==2 ? 1 : n==0 || n%100>2 && n%100<11 ? 2 : n%100>10 && n%100<20 ? 3 : 4)"),
    (6, "(n==0 ? 0 : n==1 ? 1 : n==2 ? 2 : n==3 ? 3 : n==6 ? 4 : 5)"),
    (6, "(n==0 ? 0 : n==1 ? 1 : n==2 ? 2 : n%100>=3 && n%100<=10 ? 3 : n%100>=11 ? 4 : 5)"),
];

/// The plural forms of a PO file.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct PluralForms {
    /// For each form, the plural category as the key of a variant; `""` for the text itself. `None` for a form without a
    /// category of its own: no number up to [`LARGEST`](super::LARGEST) has it, or another form has more of its numbers.
    pub(crate) keys: Vec<Option<&'static str>>,
}

impl PluralForms {
    /// Returns the forms that a file in this locale has, with the value of its header `Plural-Forms`. `None` if no known
    /// expression describes the plurals of the language.
    pub(crate) fn of(locale: &str) -> Option<(PluralForms, String)> {
        let categories = Categories::of(locale);
        let (count, expression) = KNOWN.into_iter().find(|(_, expression)| {
            let Some(expression) = Expression::parse(expression) else { return false };
            let of_numbers = (0..).zip(&categories.of_numbers);
            of_numbers
                .into_iter()
                .all(|(number, category)| expression.value(number).map(|form| form as usize) == Some(*category))
        })?;
        let forms = PluralForms::from_expression(&Expression::parse(expression)?, count, &categories);
        Some((forms, format!("nplurals={count}; plural={expression};")))
    }

    /// Returns the forms of a file in this locale by the value of its header `Plural-Forms`; `None` if it is invalid.
    pub(crate) fn of_header(value: &str, locale: &str) -> Option<PluralForms> {
        let field = |name: &str| {
            let fields = value.split(';').map(str::trim);
            fields.filter_map(|field| field.strip_prefix(name)?.trim_start().strip_prefix('=')).next().map(str::trim)
        };
        let count: usize = field("nplurals")?.parse().ok().filter(|count| matches!(count, 1..=10))?;
        Some(PluralForms::from_expression(&Expression::parse(field("plural")?)?, count, &Categories::of(locale)))
    }

    /// Gives each form the category of most of its numbers. Of several forms in a category, that with the most numbers is
    /// the one.
    fn from_expression(expression: &Expression, count: usize, categories: &Categories) -> PluralForms {
        let mut counts = vec![vec![0_usize; categories.names.len()]; count];
        for (number, category) in (0..).zip(&categories.of_numbers) {
            let form = expression.value(number).and_then(|form| counts.get_mut(form as usize));
            form.and_then(|counts| counts.get_mut(*category)).into_iter().for_each(|count| *count += 1);
        }
        let best = |counts: &Vec<usize>| {
            let (category, count) = counts.iter().enumerate().rev().max_by_key(|(_, count)| **count)?;
            Some((category, *count)).filter(|(_, count)| *count > 0)
        };
        let of_forms: Vec<Option<(usize, usize)>> = counts.iter().map(best).collect();
        let is_largest = |(category, count): (usize, usize), form: usize| {
            let mut others = of_forms.iter().enumerate().filter(|(other, _)| *other != form);
            others.all(|(other, best)| {
                best.is_none_or(|(of_other, of_count)| of_other != category || (of_count, form) < (count, other))
            })
        };
        let key = |(form, best): (usize, &Option<(usize, usize)>)| {
            let (category, _) = best.filter(|best| is_largest(*best, form))?;
            // The text itself is for the last category.
            Some(categories.variants().get(category).copied().unwrap_or(""))
        };
        PluralForms { keys: of_forms.iter().enumerate().map(key).collect() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn keys(forms: &PluralForms) -> String {
        forms
            .keys
            .iter()
            .map(|key| key.map_or("?", |key| if key.is_empty() { "-" } else { key }))
            .collect::<Vec<_>>()
            .join(" ")
    }

    #[test]
    fn languages_of_games_have_forms() {
        let of = |locale: &str| PluralForms::of(locale).map(|(forms, _)| keys(&forms)).unwrap_or_default();
        assert_eq!(of("en-us"), "one -");
        assert_eq!(of("ja-jp"), "-");
        assert_eq!(of("fr-fr"), "one -");
        assert_eq!(of("ru-ru"), "one few -");
        assert_eq!(of("pl-pl"), "one few -");
        assert_eq!(of("cs-cz"), "one few -");
        assert_eq!(of("he-il"), "one two -");
        assert_eq!(of("sl-si"), "one two few -");
        assert_eq!(of("ar-eg"), "zero one two few many -");
        assert_eq!(of("lv-lv"), "zero one -");
        let languages = "af am ar az be bg bn bs ca cs cy da de el en es et eu fa fi fil fr ga gd gl gu he hi hr hu hy id is it \
            ja ka kk km kn ko ky lo lt lv mk ml mn mr ms mt my nb ne nl nn pa pl pt ro ru si sk sl so sq sr sv sw ta te th \
            tr tzm uk ur uz vi zh zu";
        for language in languages.split_whitespace() {
            assert!(PluralForms::of(language).is_some(), "{language}");
        }
    }

    #[test]
    fn headers_of_other_tools() {
        let of = |value: &str, locale: &str| PluralForms::of_header(value, locale).map(|forms| keys(&forms));
        let is = |keys: &str| Some(keys.to_owned());
        assert_eq!(of("nplurals=2; plural=(n != 1);", "de-de"), is("one -"));
        assert_eq!(of("nplurals = 2 ; plural = n>1", "fr-fr"), is("one -"));
        assert_eq!(of("nplurals=3; plural=(n%10==1 && n%100!=11 ? 0 : n != 0 ? 1 : 2);", "lv-lv"), is("one - zero"));
        let with_fractions =
            "nplurals=4; plural=(n==1 ? 0 : n%10>=2 && n%10<=4 && (n%100<12 || n%100>14) ? 1 : n!=1 ? 2 : 3);";
        assert_eq!(of(with_fractions, "pl-pl"), is("one few - ?"), "the fourth is for fractions");
        assert_eq!(of("nplurals=2; plural=(n > 1);", "ja-jp"), is("? -"), "one category, mostly in the second form");
        let hebrew = "nplurals=4; plural=(n==1 ? 0 : n==2 ? 1 : n>10 && n%10==0 ? 2 : 3);";
        assert_eq!(of(hebrew, "he-il"), is("one two ? -"));
        assert_eq!(of("nplurals=INTEGER; plural=EXPRESSION;", "de-de"), None);
        assert_eq!(of("nplurals=99; plural=n;", "de-de"), None);
        assert_eq!(of("", "de-de"), None);
    }
}
