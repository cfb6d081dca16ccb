//! Fallback of many locales at once, in linear time, where [`chain`](super::chain) would be computed for each.

use super::cldr::{ancestors, script};
use crate::project::Options;
use crate::project::pseudo_locale::is_pseudo;
use foldhash::{HashMap, HashSet};
use lipz_file::locale::{found_keys, language, split_variant, without_category};

/// The locales of a bank or a clip, and their inheritance.
pub(crate) struct Fallbacks {
    locales: Vec<Locale>,
    default: Option<usize>,
    /// The variants, by the number of their locale and their key.
    variants: HashMap<(usize, Box<str>), usize>,
    /// The nearest locale with a text for each group.
    nearest: Vec<Option<Rank>>,
    /// The groups that have one.
    found: Vec<u32>,
}

/// The inheritance of one locale.
struct Locale {
    /// The locales that it falls back to, if the project names them.
    named: Option<Vec<usize>>,
    /// Whether others fall back to it.
    is_offered: bool,
    /// The groups of locales in which it looks for a text, in order: those that share an ancestor, then those of its
    /// language, all in its script. Those of a variant are those of its locale.
    groups: Vec<u32>,
    /// The language, in the tag.
    language: Box<str>,
    /// If it is a variant: the number of the locale that it varies, if some clip has texts in it, and the key.
    variant: Option<(Option<usize>, Box<str>)>,
}

/// The distance of a locale from the ancestor that a group shares, whether it is not the default locale, and its
/// number.
type Rank = (usize, bool, usize);

impl Fallbacks {
    /// Creates it from the tags of the locales, in order.
    pub(crate) fn new<T: AsRef<str>>(tags: &[T], options: &Options) -> Fallbacks {
        let numbers: HashMap<&str, usize> = tags.iter().map(AsRef::as_ref).zip(0..).collect();
        let mut groups: HashMap<(String, Option<String>), u32> = HashMap::default();
        let mut locales = Vec::with_capacity(tags.len());
        let mut variants = HashMap::default();
        for (number, tag) in tags.iter().map(AsRef::as_ref).enumerate() {
            let (tag, key) = split_variant(tag);
            let variant = key.map(|key| {
                let varied = numbers.get(tag).copied();
                variants.extend(varied.map(|varied| ((varied, key.into()), number)));
                (varied, key.into())
            });
            let script = script(tag);
            // Tags contain no slash, so that groups of languages and of ancestors have different names.
            let names = ancestors(tag).into_iter().chain([format!("{}/", language(tag))]);
            let mut group = |name: String| {
                let next = groups.len() as u32;
                *groups.entry((name, script.map(str::to_owned))).or_insert(next)
            };
            let named = options.fallbacks.get(tag).map(|named| {
                let known = named.iter().filter_map(|tag| numbers.get(tag.as_str()).copied());
                known.filter(|&other| other != number).collect()
            });
            let groups = names.map(&mut group).collect();
            let is_offered = !is_pseudo(tag) && variant.is_none();
            locales.push(Locale { named, is_offered, groups, language: language(tag).into(), variant });
        }
        let default = options.default_locale.as_deref().and_then(|tag| numbers.get(tag).copied());
        Fallbacks { locales, default, variants, nearest: vec![None; groups.len()], found: Vec::new() }
    }

    /// Calls `show` for each of the `missing` locales with its fallback, in a clip that has texts in the locales `own`:
    /// the first of [`chain`](super::chain) that has a text.
    pub(crate) fn resolve(
        &mut self,
        own: impl Iterator<Item = usize>,
        missing: impl Iterator<Item = usize>,
        mut show: impl FnMut(usize, usize),
    ) {
        let mut has_text: HashSet<usize> = HashSet::default();
        for number in own {
            has_text.insert(number);
            let Some(locale) = self.locales.get(number).filter(|locale| locale.is_offered) else { continue };
            let last = locale.groups.len() - 1;
            for (depth, &group) in locale.groups.iter().enumerate() {
                // In the group of a language, all have the same rank.
                let depth = if depth == last { 0 } else { depth };
                let rank = (depth, Some(number) != self.default, number);
                let nearest = &mut self.nearest[group as usize];
                if nearest.is_none() {
                    self.found.push(group);
                }
                *nearest = Some(nearest.map_or(rank, |known| known.min(rank)));
            }
        }
        for number in missing {
            let Some(locale) = self.locales.get(number) else { continue };
            let other = match &locale.variant {
                Some((varied, key)) => self.in_place_of_variant(locale, (*varied, key), &has_text),
                None => self.in_place_of(locale, &has_text),
            };
            if let Some(other) = other {
                show(number, other);
            }
        }
        for group in self.found.drain(..) {
            self.nearest[group as usize] = None;
        }
    }

    /// Returns the locale whose text a clip shows in place of a missing one.
    fn in_place_of(&self, locale: &Locale, has_text: &HashSet<usize>) -> Option<usize> {
        if let Some(named) = &locale.named {
            return named.iter().copied().find(|other| has_text.contains(other));
        }
        let of_group = |&group: &u32| self.nearest[group as usize].map(|(_, _, other)| other);
        let default = || self.default.filter(|default| has_text.contains(default));
        locale.groups.iter().find_map(of_group).or_else(default)
    }

    /// Returns the locale or variant whose text a clip shows in place of a missing variant: in the locale whose text it
    /// shows in general, the variant that the key finds, or else that text. In another language, a plural category finds
    /// nothing.
    fn in_place_of_variant(
        &self,
        locale: &Locale,
        (varied, key): (Option<usize>, &str),
        has_text: &HashSet<usize>,
    ) -> Option<usize> {
        let has_text_in = |number: &usize| has_text.contains(number);
        let shown = varied.filter(has_text_in).or_else(|| self.in_place_of(locale, has_text))?;
        let variant = |key: &str| self.variants.get(&(shown, key.into())).copied().filter(has_text_in);
        let is_alike = self.locales.get(shown).is_some_and(|other| other.language == locale.language);
        let key = if is_alike { Some(key) } else { without_category(key) };
        key.and_then(|key| found_keys(key).find_map(variant)).or(Some(shown))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::locales::fallback::chain;
    use proptest::prelude::*;

    const TAGS: [&str; 22] = [
        "de-at", "de-ch", "de-de", "en-au", "en-gb", "en-us", "en-xa", "es-419", "es-ar", "es-es", "es-mx", "hi-latn",
        "nb-no", "nn-no", "pt-ao", "pt-br", "pt-pt", "qq-xx", "sr-me", "sr-rs", "zh-cn", "zh-tw",
    ];

    #[test]
    fn a_variant_falls_back_within_the_shown_locale() {
        let tags = [
            "de-at-x-few-fem",
            "de-at",
            "de-at-x-few",
            "de-de",
            "de-de-x-fem",
            "de-de-x-few",
            "de-de-x-few-fem",
            "de-de-x-one",
            "en-us",
            "en-us-x-fem",
            "en-us-x-one",
            "ru-ru-x-one",
            "ru-ru-x-one-fem",
        ];
        let number = |tag: &str| tags.iter().position(|known| *known == tag).unwrap();
        let mut fallbacks = Fallbacks::new(&tags, &Options::new().default_locale("en-us").unwrap());
        let mut shown = |own: &[&str], missing: &str| {
            let mut found = None;
            let own = own.iter().map(|tag| number(tag));
            fallbacks.resolve(own, [number(missing)].into_iter(), |_, other| found = Some(tags[other]));
            found
        };
        assert_eq!(shown(&["de-de", "de-de-x-few"], "de-de-x-few-fem"), Some("de-de-x-few"), "a part of the key");
        assert_eq!(shown(&["de-de", "de-de-x-one"], "de-de-x-few"), Some("de-de"));
        assert_eq!(shown(&["de-de", "de-de-x-few"], "de-at-x-few"), Some("de-de-x-few"), "that of the fallback");
        assert_eq!(shown(&["de-at", "de-de", "de-de-x-few"], "de-at-x-few"), Some("de-at"), "a text of its own first");
        let genders = ["de-de", "de-de-x-fem", "de-de-x-one"];
        assert_eq!(shown(&genders, "de-de-x-few-fem"), Some("de-de-x-fem"), "a gender without the number");
        assert_eq!(shown(&genders, "de-at-x-few-fem"), Some("de-de-x-fem"));
        assert_eq!(shown(&["de-de", "de-de-x-fem"], "de-de-x-few"), Some("de-de"), "the key has no gender");
        let english = ["en-us", "en-us-x-fem", "en-us-x-one"];
        assert_eq!(shown(&english, "ru-ru-x-one"), Some("en-us"), "other numbers than in English, such as 21");
        assert_eq!(shown(&english, "ru-ru-x-one-fem"), Some("en-us-x-fem"), "a gender is one in all languages");
        assert_eq!(shown(&["de-de-x-one"], "de-de"), None, "no locale falls back to a variant");
        assert_eq!(shown(&[], "de-de-x-few"), None);
    }

    proptest! {
        #[test]
        fn the_nearest_is_the_first_of_the_chain_with_a_text(
            chosen in proptest::sample::subsequence(&TAGS[..], 1..TAGS.len()),
            own in any::<[u32; 3]>(),
            default in proptest::option::of(proptest::sample::select(&TAGS[..])),
            named in proptest::collection::btree_map(
                proptest::sample::select(&TAGS[..]), proptest::sample::subsequence(&TAGS[..], 0..4), 0..3),
        ) {
            let mut options = Options::new().extended_locales(true);
            options.default_locale = default.map(str::to_owned);
            for (tag, chain) in named {
                options = options.fallback(tag, chain).unwrap();
            }
            let mut fallbacks = Fallbacks::new(&chosen, &options);
            for own in own {
                let has = |number: &usize| own >> number & 1 == 1;
                let mut found = vec![None; chosen.len()];
                let all = || 0..chosen.len();
                fallbacks.resolve(all().filter(has), all().filter(|number| !has(number)), |locale, other| {
                    found[locale] = Some(other);
                });
                for locale in all().filter(|number| !has(number)) {
                    let expected = chain(&chosen, locale, &options).into_iter().find(has);
                    prop_assert_eq!(found[locale], expected, "{}", chosen[locale]);
                }
            }
        }
    }
}
