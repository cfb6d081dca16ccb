//! Language tags (the part of BCP 47 that Unicode calls language identifiers), in lower case.

/// The parts of a language tag in lower case: `zh`, `hant` and `tw` of `zh-hant-tw`.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct LanguageTag<'t> {
    /// Two or three letters.
    pub language: &'t str,
    /// Four letters.
    pub script: Option<&'t str>,
    /// Two letters or three digits.
    pub region: Option<&'t str>,
    /// The alphabetically first variant.
    pub variant: Option<&'t str>,
}

impl<'t> LanguageTag<'t> {
    /// Parses a tag in lower case; `None` if it is not a language tag, or has extensions.
    ///
    /// ```
    /// use lipz_file::locale::LanguageTag;
    /// let tag = LanguageTag::parse("zh-hant-tw").ok_or("no tag")?;
    /// assert_eq!((tag.language, tag.script, tag.region), ("zh", Some("hant"), Some("tw")));
    /// assert_eq!(LanguageTag::parse("english"), None);
    /// # Ok::<(), &str>(())
    /// ```
    pub fn parse(tag: &'t str) -> Option<LanguageTag<'t>> {
        let mut subtags = tag.split('-').peekable();
        let language = subtags.next().filter(|subtag| matches!(subtag.len(), 2..=3) && is_alphabetic(subtag))?;
        let script = subtags.next_if(|subtag| subtag.len() == 4 && is_alphabetic(subtag));
        let region = subtags.next_if(|subtag| is_region(subtag));
        let mut variants: Vec<&str> = Vec::new();
        for subtag in subtags {
            if !is_variant(subtag) || variants.contains(&subtag) {
                return None;
            }
            variants.push(subtag);
        }
        Some(LanguageTag { language, script, region, variant: variants.into_iter().min() })
    }
}

fn is_alphabetic(subtag: &str) -> bool {
    subtag.bytes().all(|byte| byte.is_ascii_lowercase())
}

fn is_region(subtag: &str) -> bool {
    (subtag.len() == 2 && is_alphabetic(subtag))
        || (subtag.len() == 3 && subtag.bytes().all(|byte| byte.is_ascii_digit()))
}

/// Five to eight letters and digits, or a digit followed by three of them.
fn is_variant(subtag: &str) -> bool {
    let is_alphanumeric = subtag.bytes().all(|byte| byte.is_ascii_lowercase() || byte.is_ascii_digit());
    let has_length = match subtag.len() {
        4 => subtag.starts_with(|c: char| c.is_ascii_digit()),
        length => matches!(length, 5..=8),
    };
    is_alphanumeric && has_length
}

#[cfg(test)]
mod tests {
    use super::*;
    use icu_locale_core::LanguageIdentifier;

    /// Subtags of every length and kind, in all positions: ICU accepts the same tags and finds the same parts.
    #[test]
    fn tags_are_those_of_icu() {
        let subtags = [
            "",
            "a",
            "1",
            "de",
            "1a",
            "419",
            "deu",
            "d1u",
            "latn",
            "1994",
            "1a2b",
            "a123",
            "rozaj",
            "biske",
            "12345",
            "valencia",
            "monoton1",
            "toolonggg",
            "é",
            "u",
            "x",
            "und",
        ];
        let mut tags: Vec<String> = subtags.map(str::to_owned).to_vec();
        let mut longer = tags.clone();
        for _ in 0..3 {
            longer = longer.iter().flat_map(|tag| subtags.map(|subtag| format!("{tag}-{subtag}"))).collect();
            tags.extend(longer.iter().cloned());
        }
        let mut count = 0;
        for tag in &tags {
            let expected = tag.parse::<LanguageIdentifier>().ok();
            let found = LanguageTag::parse(tag);
            assert_eq!(found.is_some(), expected.is_some(), "{tag}");
            let (Some(found), Some(expected)) = (found, expected) else { continue };
            let lower = |part: Option<String>| part.map(|part| part.to_ascii_lowercase());
            assert_eq!(found.language, expected.language.as_str(), "{tag}");
            assert_eq!(
                found.script.map(str::to_owned),
                lower(expected.script.map(|script| script.to_string())),
                "{tag}"
            );
            assert_eq!(
                found.region.map(str::to_owned),
                lower(expected.region.map(|region| region.to_string())),
                "{tag}"
            );
            let variant = expected.variants.iter().next().map(ToString::to_string);
            assert_eq!(found.variant.map(str::to_owned), variant, "{tag}");
            count += 1;
        }
        assert!(count > 100, "{count}");
    }
}
