//! The spellings of locales in other programs.

/// Returns the locale with the country in capitals, as BCP 47 recommends: `de-DE`, `zh-Hant-TW`.
pub(crate) fn bcp47(locale: &str) -> String {
    let mut parts = locale.split('-');
    let mut tag = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        tag.push('-');
        match part.len() {
            2 => tag.push_str(&part.to_ascii_uppercase()),
            4 if part.starts_with(|first: char| first.is_ascii_alphabetic()) => {
                tag.push_str(&part.get(..1).unwrap_or_default().to_ascii_uppercase());
                tag.push_str(part.get(1..).unwrap_or_default());
            }
            _ => tag.push_str(part),
        }
    }
    tag
}

/// Returns the locale in the form of gettext and Godot: `de_DE`.
pub(crate) fn underscored(locale: &str) -> String {
    bcp47(locale).replace('-', "_")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tags_have_capitals() {
        assert_eq!(["de-de", "de", "zh-hant-tw", "es-419"].map(bcp47), ["de-DE", "de", "zh-Hant-TW", "es-419"]);
        assert_eq!(underscored("pt-br"), "pt_BR");
    }
}
