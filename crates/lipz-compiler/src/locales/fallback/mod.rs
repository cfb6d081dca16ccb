//! The fallback locales of a locale.

mod cldr;
mod nearest;
mod table;

pub(crate) use cldr::script;
pub(crate) use nearest::Fallbacks;

use crate::project::Options;
use crate::project::pseudo_locale::is_pseudo;
use cldr::ancestors;
use lipz_file::locale::{is_variant, language};

/// Returns the indexes in `tags` of the locales that `tags[locale]` falls back to, in order.
///
/// If the project names them, these are used. Otherwise, they follow the inheritance of Unicode's CLDR: for Argentina,
/// first a text for Latin America (`es-419`), then one for Spain; then other locales of the same language in the same
/// script, then the default locale. Among equals, the default locale goes first, then the order of the tags applies.
///
/// [`Fallbacks`] returns the same answers for many locales at once, and also those for variants.
pub(crate) fn chain<T: AsRef<str>>(tags: &[T], locale: usize, options: &Options) -> Vec<usize> {
    let place = |tag: &str| tags.iter().position(|known| known.as_ref() == tag);
    if let Some(named) = options.fallbacks.get(tags[locale].as_ref()) {
        return named.iter().filter_map(|tag| place(tag)).filter(|&other| other != locale).collect();
    }
    let default = options.default_locale.as_deref().and_then(place);
    let own = tags[locale].as_ref();
    let wanted = ancestors(own);
    let mut ranked: Vec<_> = (0..tags.len())
        .filter(|&other| other != locale && !is_pseudo(tags[other].as_ref()) && !is_variant(tags[other].as_ref()))
        .filter(|&other| script(tags[other].as_ref()) == script(own))
        .filter_map(|other| {
            let distance = distance(&wanted, &ancestors(tags[other].as_ref()));
            let is_same_language = language(tags[other].as_ref()) == language(own);
            let distance = distance.or(is_same_language.then_some((usize::MAX, 0)))?;
            Some((distance, Some(other) != default, other))
        })
        .collect();
    ranked.sort_unstable();
    let mut chain: Vec<usize> = ranked.into_iter().map(|(_, _, other)| other).collect();
    chain.extend(default.filter(|default| *default != locale && !chain.contains(default)));
    chain
}

/// Returns the steps from a locale to the nearest ancestor that it shares with another, and from there to the other;
/// `None` if they share none.
fn distance(wanted: &[String], other: &[String]) -> Option<(usize, usize)> {
    wanted.iter().enumerate().find_map(|(up, tag)| Some((up, other.iter().position(|known| known == tag)?)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chain_of(tag: &str, tags: &[&'static str], options: &Options) -> Vec<&'static str> {
        let locale = tags.iter().position(|known| *known == tag).unwrap();
        chain(tags, locale, options).into_iter().map(|other| tags[other]).collect()
    }

    fn default(tag: &str) -> Options {
        Options::new().default_locale(tag).unwrap()
    }

    #[test]
    fn parents_of_cldr_come_first() {
        let spanish = ["en-us", "es-ar", "es-es", "es-mx"];
        assert_eq!(chain_of("es-ar", &spanish, &default("en-us")), ["es-mx", "es-es", "en-us"]);
        assert_eq!(chain_of("es-es", &spanish, &default("en-us")), ["es-ar", "es-mx", "en-us"]);
        let english = ["en-au", "en-gb", "en-us"];
        assert_eq!(chain_of("en-au", &english, &default("en-us")), ["en-gb", "en-us"]);
        assert_eq!(chain_of("pt-ao", &["pt-ao", "pt-br", "pt-pt"], &default("pt-br")), ["pt-pt", "pt-br"]);
        assert_eq!(chain_of("nb-no", &["da-dk", "nb-no", "nn-no"], &Options::default()), ["nn-no"]);
    }

    #[test]
    fn another_script_is_read_only_by_choice() {
        let chinese = ["en-us", "zh-cn", "zh-hk", "zh-sg", "zh-tw"];
        assert_eq!(chain_of("zh-hk", &chinese, &default("en-us")), ["zh-tw", "en-us"]);
        assert_eq!(chain_of("zh-sg", &chinese, &default("en-us")), ["zh-cn", "en-us"]);
        assert_eq!(chain_of("zh-tw", &chinese, &default("zh-cn")), ["zh-hk", "zh-cn"], "the default is a choice");
        let named = default("en-us").fallback("zh-tw", ["zh-cn"]).unwrap();
        assert_eq!(chain_of("zh-tw", &chinese, &named), ["zh-cn"]);
        let others = ["az-az", "az-ir", "pa-in", "pa-pk", "sr-me", "sr-rs", "uz-af", "uz-uz"];
        for tag in others {
            assert!(chain_of(tag, &others, &Options::default()).is_empty(), "{tag}");
        }
        let serbian = ["sr-cyrl-me", "sr-latn-rs", "sr-me", "sr-rs"];
        assert_eq!(chain_of("sr-cyrl-me", &serbian, &Options::default()), ["sr-rs"]);
        assert_eq!(chain_of("sr-latn-rs", &serbian, &Options::default()), ["sr-me"]);
    }

    #[test]
    fn the_default_goes_first_among_equals() {
        let german = ["de-at", "de-ch", "de-de", "fr-fr"];
        assert_eq!(chain_of("de-at", &german, &default("de-de")), ["de-de", "de-ch"]);
        assert_eq!(chain_of("de-at", &german, &Options::default()), ["de-ch", "de-de"]);
        assert_eq!(chain_of("fr-fr", &german, &default("de-de")), ["de-de"]);
        assert!(chain_of("fr-fr", &german, &Options::default()).is_empty());
    }

    #[test]
    fn a_project_names_its_own() {
        let fallbacks = [("de-at".to_owned(), vec!["en-us".to_owned(), "xx-yy".to_owned(), "de-de".to_owned()])];
        let options = Options { fallbacks: fallbacks.into(), ..default("de-de") };
        assert_eq!(chain_of("de-at", &["de-at", "de-de", "en-us"], &options), ["en-us", "de-de"]);
    }

    #[test]
    fn nobody_falls_back_to_a_pseudo_locale() {
        assert_eq!(chain_of("en-gb", &["en-gb", "en-us", "en-xa"], &default("en-us")), ["en-us"]);
        assert_eq!(chain_of("en-xa", &["en-gb", "en-us", "en-xa"], &default("en-us")), ["en-us", "en-gb"]);
    }
}
