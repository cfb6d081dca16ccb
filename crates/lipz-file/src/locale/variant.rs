//! Variants of texts: the subtags after `-x-` in the tag of a locale (BCP 47, section 2.2.7, "Private Use Subtags").
//!
//! A variant is the text of a locale for a number, a gender or a form of address: `text_pl-pl-x-few` is the Polish text
//! for two to four things. Its key consists of one or more names of at most eight letters and digits: `few`, `fem`,
//! `few-fem`. Because a variant has a tag like a locale, a bank and its readers need nothing else for it.

/// The subtag between a locale and the key of a variant, with its hyphens.
const SEPARATOR: &str = "-x-";

/// The longest name in the key of a variant, in bytes (BCP 47).
pub const LONGEST_NAME: usize = 8;

/// The longest key of a variant, in bytes: the length that BCP 47 recommends for the tags of a program (RFC 5646,
/// section 4.4.1). Without a limit, a search for the beginnings of a key would take quadratic time.
pub const LONGEST_KEY: usize = 35;

/// The plural categories of Unicode's CLDR (UTS 35, part 3, "Language Plural Rules").
const PLURAL_CATEGORIES: [&str; 6] = ["zero", "one", "two", "few", "many", "other"];

/// Splits the tag of a text into its locale and the key of its variant, if it has one.
///
/// ```
/// use lipz_file::locale::split_variant;
/// assert_eq!(split_variant("pl-pl-x-few-fem"), ("pl-pl", Some("few-fem")));
/// assert_eq!(split_variant("pl-pl"), ("pl-pl", None));
/// ```
pub fn split_variant(tag: &str) -> (&str, Option<&str>) {
    match tag.split_once(SEPARATOR) {
        Some((locale, key)) => (locale, Some(key)),
        None => (tag, None),
    }
}

/// Returns the tag of a variant, or with an empty key that of the locale.
///
/// ```
/// use lipz_file::locale::variant_tag;
/// assert_eq!(variant_tag("pl-pl", "few"), "pl-pl-x-few");
/// assert_eq!(variant_tag("pl-pl", ""), "pl-pl");
/// ```
pub fn variant_tag(locale: &str, key: &str) -> String {
    if key.is_empty() { locale.to_owned() } else { format!("{locale}{SEPARATOR}{key}") }
}

/// Whether a tag is that of a variant.
pub fn is_variant(tag: &str) -> bool {
    split_variant(tag).1.is_some()
}

/// Whether `key` can be the key of a variant: names of one to eight lower-case letters and digits, joined by hyphens, at
/// most [`LONGEST_KEY`] bytes in all.
///
/// ```
/// use lipz_file::locale::is_variant_key;
/// assert!(is_variant_key("few") && is_variant_key("one-fem"));
/// assert!(!is_variant_key("Few") && !is_variant_key("masculine") && !is_variant_key("one--fem"));
/// assert!(is_variant_key(&["fem"; 9].join("-")) && !is_variant_key(&["fem"; 10].join("-")));
/// ```
pub fn is_variant_key(key: &str) -> bool {
    let is_letter = |byte: u8| byte.is_ascii_lowercase() || byte.is_ascii_digit();
    let is_name = |name: &str| matches!(name.len(), 1..=LONGEST_NAME) && name != "x" && name.bytes().all(is_letter);
    key.len() <= LONGEST_KEY && key.split('-').all(is_name)
}

/// Returns the keys that a game's key finds within a locale, in the order of the search: the key and its beginnings, so
/// that a number wins, then the same without the leading plural category, so that a gender wins over nothing.
///
/// ```
/// use lipz_file::locale::found_keys;
/// assert_eq!(found_keys("few-fem").collect::<Vec<_>>(), ["few-fem", "few", "fem"]);
/// assert_eq!(found_keys("fem-formal").collect::<Vec<_>>(), ["fem-formal", "fem"]);
/// ```
pub fn found_keys(key: &str) -> impl Iterator<Item = &str> {
    let behind = without_category(key).filter(|behind| behind.len() < key.len());
    [Some(key), behind].into_iter().flatten().flat_map(beginnings)
}

/// Splits a key into its plural category, which comes first, and the rest, which is the key if there is no category.
///
/// ```
/// use lipz_file::locale::split_category;
/// assert_eq!(split_category("few-fem"), (Some("few"), "fem"));
/// assert_eq!(split_category("few"), (Some("few"), ""));
/// assert_eq!(split_category("fem-few"), (None, "fem-few"));
/// ```
pub fn split_category(key: &str) -> (Option<&str>, &str) {
    let (first, rest) = key.split_once('-').unwrap_or((key, ""));
    if PLURAL_CATEGORIES.contains(&first) { (Some(first), rest) } else { (None, key) }
}

/// Returns the key without its leading plural category, or `None` if nothing is left. In a text of another language,
/// only this part selects a variant, because the category stands for other numbers there: the Russian `one` includes 21.
///
/// ```
/// use lipz_file::locale::without_category;
/// assert_eq!(without_category("few-fem"), Some("fem"));
/// assert_eq!(without_category("fem"), Some("fem"));
/// assert_eq!(without_category("few"), None);
/// ```
pub fn without_category(key: &str) -> Option<&str> {
    Some(split_category(key).1).filter(|rest| !rest.is_empty())
}

/// Returns the key and its beginnings, from long to short: `few-fem`, `few`.
fn beginnings(key: &str) -> impl Iterator<Item = &str> {
    std::iter::successors(Some(key), |key| Some(key.rsplit_once('-')?.0))
}
