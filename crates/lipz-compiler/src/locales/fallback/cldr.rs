//! Inheritance between locales in Unicode's CLDR (UTS #35, "Locale Inheritance and Matching").
//!
//! The tables are those of ICU4X. They are copied so that build scripts need not compile ICU4X: the tests below
//! generate them and compare the answers.

use super::table::{LANGUAGE_SCRIPTS, PARENTS, REGION_SCRIPTS};
use lipz_file::locale::LanguageTag;

/// The language of the root locale, from which all others inherit.
const ROOT: LanguageTag<'static> = LanguageTag { language: "und", script: None, region: None, variant: None };

/// Returns a locale and those that it inherits from, without the root: `es-ar`, `es-419`, `es`. For a text that is not
/// a language tag, returns only the text.
pub(super) fn ancestors(tag: &str) -> Vec<String> {
    let Some(mut locale) = LanguageTag::parse(tag) else { return vec![tag.to_owned()] };
    let implied = implied_script(&locale);
    if implied.is_some() && locale.script == implied {
        locale.script = None;
    }
    let max_script = locale.script.or(implied);
    let mut variant = None;
    let mut ancestors = Vec::new();
    while locale != ROOT {
        ancestors.push(name(&locale));
        locale = parent(locale, max_script, &mut variant);
    }
    ancestors
}

/// Returns the script of texts in a locale, from its tag or from its language and region ("likely subtags" of CLDR);
/// `None` for unknown languages.
pub(crate) fn script(tag: &str) -> Option<&str> {
    let locale = LanguageTag::parse(tag)?;
    let of_parent = || find(PARENTS, locale.language).and_then(script);
    locale
        .script
        .or_else(|| implied_script(&locale))
        .or_else(|| find(LANGUAGE_SCRIPTS, locale.language))
        .or_else(of_parent)
}

/// Returns the script that language and region imply; `None` for a language alone.
fn implied_script<'t>(locale: &LanguageTag<'t>) -> Option<&'t str> {
    if locale.script.is_none() && locale.region.is_none() {
        return None;
    }
    let of_region = locale.region.and_then(|region| find(REGION_SCRIPTS, &format!("{}-{region}", locale.language)));
    of_region.or_else(|| find(LANGUAGE_SCRIPTS, locale.language))
}

/// Returns the next locale to inherit from. `variant` keeps the variants removed first, which the parent may have as
/// well.
fn parent<'t>(locale: LanguageTag<'t>, max_script: Option<&'t str>, variant: &mut Option<&'t str>) -> LanguageTag<'t> {
    if locale.variant.is_some() {
        *variant = locale.variant;
        return LanguageTag { variant: None, ..locale };
    }
    if let Some(parent) = find(PARENTS, &name(&locale)).and_then(LanguageTag::parse) {
        return LanguageTag { variant: variant.take(), ..parent };
    }
    if locale.region.is_some() {
        let is_implied = find(LANGUAGE_SCRIPTS, locale.language) == max_script;
        let script = if is_implied { None } else { max_script };
        return LanguageTag { language: locale.language, script, region: None, variant: variant.take() };
    }
    ROOT
}

fn name(locale: &LanguageTag<'_>) -> String {
    let parts = [Some(locale.language), locale.script, locale.region, locale.variant];
    parts.into_iter().flatten().collect::<Vec<_>>().join("-")
}

/// Returns the value of a key in a sorted table.
fn find(table: &'static [(&str, &'static str)], key: &str) -> Option<&'static str> {
    let at = table.binary_search_by(|(known, _)| (*known).cmp(key)).ok()?;
    table.get(at).map(|(_, value)| *value)
}

#[cfg(test)]
mod tests {
    use super::*;
    use icu_locale::Locale;
    use icu_locale::fallback::LocaleFallbacker;
    use icu_locale::fallback::provider::{Baked, LocaleLikelySubtagsLanguageV1, LocaleParentsV1};
    use icu_provider::{DataProvider, DataRequest, DataResponse};
    use std::collections::{BTreeMap, BTreeSet};
    use std::fmt::Write;
    use std::{env, fs, iter};

    const PATH: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/src/locales/fallback/table.rs");

    type Pairs = BTreeMap<String, String>;

    /// Returns the tables of ICU4X: parents, scripts of languages, scripts of languages in regions.
    fn tables_of_icu() -> [Pairs; 3] {
        let parents: DataResponse<LocaleParentsV1> = Baked.load(DataRequest::default()).unwrap();
        let likely: DataResponse<LocaleLikelySubtagsLanguageV1> = Baked.load(DataRequest::default()).unwrap();
        let (parents, likely) = (parents.payload.get(), likely.payload.get());
        let parents = parents.parents.iter_copied_values().map(|(tag, (language, script, region))| {
            let parts = [Some(language.to_string()), script.map(|s| s.to_string()), region.map(|r| r.to_string())];
            let parent = parts.into_iter().flatten().collect::<Vec<_>>().join("-");
            (String::from_utf8_lossy(tag).to_ascii_lowercase(), parent.to_ascii_lowercase())
        });
        let languages = likely.language.iter_copied().map(|(language, (script, _))| {
            (language.try_into_tinystr().unwrap().to_string(), script.to_string().to_ascii_lowercase())
        });
        let regions = likely.language_region.iter_copied().map(|((language, region), script)| {
            let (language, region) = (language.try_into_tinystr().unwrap(), region.try_into_tinystr().unwrap());
            (format!("{language}-{region}").to_ascii_lowercase(), script.to_string().to_ascii_lowercase())
        });
        [parents.collect(), languages.collect(), regions.collect()]
    }

    fn written([parents, languages, regions]: &[Pairs; 3]) -> String {
        let mut text =
            "//! Tables of CLDR, made by `LIPZ_BLESS=1 cargo test -p lipz-compiler --lib cldr`; sorted by key.\n"
                .to_owned();
        let tables = [
            ("Parents of locales that are not what is left without the last part.", "PARENTS", parents),
            ("The usual script of a language.", "LANGUAGE_SCRIPTS", languages),
            (
                "The usual script of a language in a region, where it is not that of the language.",
                "REGION_SCRIPTS",
                regions,
            ),
        ];
        for (about, name, pairs) in tables {
            write!(text, "\n/// {about}\n#[rustfmt::skip]\npub(super) const {name}: &[(&str, &str)] = &[").unwrap();
            let mut width = usize::MAX;
            for (key, value) in pairs {
                let pair = format!("(\"{key}\", \"{value}\"),");
                if width.saturating_add(1 + pair.len()) > 116 {
                    text.push_str("\n   ");
                    width = 3;
                }
                width += 1 + pair.len();
                write!(text, " {pair}").unwrap();
            }
            text.push_str("\n];\n");
        }
        text
    }

    #[test]
    fn the_tables_are_those_of_icu() {
        let expected = written(&tables_of_icu());
        if env::var_os("LIPZ_BLESS").is_some() {
            fs::write(PATH, &expected).unwrap();
        }
        assert!(fs::read_to_string(PATH).unwrap() == expected, "LIPZ_BLESS=1 makes the tables anew");
    }

    fn ancestors_of_icu(tag: &str) -> Vec<String> {
        let Ok(locale) = tag.parse::<Locale>() else { return vec![tag.to_owned()] };
        let fallbacker = LocaleFallbacker::new();
        let mut steps = fallbacker.for_config(Default::default()).fallback_for(locale.into());
        let mut ancestors = Vec::new();
        while !steps.get().is_unknown() {
            ancestors.push(steps.get().to_string().to_ascii_lowercase());
            steps.step();
        }
        ancestors
    }

    #[test]
    fn scripts_of_locales() {
        for (tag, expected) in [
            ("zh-cn", "hans"),
            ("zh-sg", "hans"),
            ("zh", "hans"),
            ("zh-tw", "hant"),
            ("zh-hk", "hant"),
            ("zh-mo", "hant"),
            ("zh-hant-cn", "hant"),
            ("sr-rs", "cyrl"),
            ("sr-me", "latn"),
            ("sr-latn", "latn"),
            ("uz-uz", "latn"),
            ("uz-af", "arab"),
            ("uz-cyrl-uz", "cyrl"),
            ("az-az", "latn"),
            ("az-ir", "arab"),
            ("pa-in", "guru"),
            ("pa-pk", "arab"),
            ("kk-kz", "cyrl"),
            ("kk-cn", "arab"),
            ("mn-mn", "cyrl"),
            ("mn-cn", "mong"),
            ("ha-ng", "latn"),
            ("hi-in", "deva"),
            ("hi-latn", "latn"),
            ("ja-jp", "jpan"),
            ("nb-no", "latn"),
        ] {
            assert_eq!(script(tag), Some(expected), "{tag}");
        }
        assert_eq!(script("qq-xx"), None);
    }

    /// Tests every language of the tables and some others with every script and region of the tables.
    #[test]
    fn ancestors_are_those_of_icu() {
        let known: BTreeSet<&str> = [PARENTS, LANGUAGE_SCRIPTS, REGION_SCRIPTS]
            .concat()
            .into_iter()
            .flat_map(|(key, value)| [key, value])
            .collect();
        let letters = || (b'a'..=b'z').map(char::from);
        let pairs: Vec<String> = letters().flat_map(|a| letters().map(move |b| format!("{a}{b}"))).collect();
        let parsed: Vec<_> = known.iter().filter_map(|tag| LanguageTag::parse(tag)).collect();
        let languages: BTreeSet<&str> = parsed.iter().map(|tag| tag.language).chain(["qq", "xx", "iw"]).collect();
        let regions: BTreeSet<&str> =
            parsed.iter().filter_map(|tag| tag.region).chain(pairs.iter().map(String::as_str)).collect();
        let scripts: BTreeSet<&str> = known.iter().copied().filter(|part| part.len() == 4).collect();
        let check = |tag: &str| assert_eq!(ancestors(tag), ancestors_of_icu(tag), "{tag}");
        known.iter().for_each(|tag| check(tag));
        for language in &languages {
            check(language);
            regions.iter().for_each(|region| check(&format!("{language}-{region}")));
        }
        // All combinations would be too many: test scripts only with the languages and regions that have tables.
        let tabled: BTreeSet<&str> = parsed.iter().filter(|tag| tag.region.is_some()).map(|tag| tag.language).collect();
        for language in tabled.into_iter().chain(["de", "und"]) {
            for script in scripts.iter().copied().chain(iter::once("zzzz")) {
                check(&format!("{language}-{script}"));
                ["at", "us", "tw", "hk", "001"]
                    .iter()
                    .for_each(|region| check(&format!("{language}-{script}-{region}")));
            }
        }
        for tag in
            ["de-1901", "de-at-1901", "en-au-scouse-oxendict", "zh-hant-hk-1901", "pt-ao-abl1943", "x", "a-b", ""]
        {
            check(tag);
        }
    }
}
