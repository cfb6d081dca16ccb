//! Locales of the bank, and which text each clip shows in each of them.

use crate::clip::ClipData;
use crate::{Options, fallback};
use std::collections::BTreeMap;

/// The locales of a bank with the texts of all clips.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Localised {
    /// In the order of their tags.
    pub(crate) locales: Vec<LocaleColumn>,
}

/// The texts of one locale.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct LocaleColumn {
    pub(crate) tag: String,
    pub(crate) is_default: bool,
    /// For each clip: where its text is.
    pub(crate) texts: Vec<Choice>,
}

/// Where the text of a clip in a locale is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Choice {
    /// The clip has a text in the locale: its index in `ClipData::texts`.
    Own(u32),
    /// It does not, and shows that of the locale with this index.
    Fallback(u32),
    /// Nor in any locale that this one falls back to.
    Missing,
}

/// Finds the locales of `clips` and resolves fallback; [`fallback::chain`] has the rule.
pub(crate) fn localise(clips: &[ClipData], options: &Options) -> Localised {
    let default = options.default_locale.as_deref();
    let mut index_of: BTreeMap<&str, usize> = BTreeMap::new();
    for text in clips.iter().flat_map(|clip| &clip.texts) {
        if !index_of.contains_key(text.locale.as_ref()) {
            index_of.insert(&text.locale, 0);
        }
    }
    for (index, (_, value)) in index_of.iter_mut().enumerate() {
        *value = index;
    }
    let tags: Vec<&str> = index_of.keys().copied().collect();
    let mut own = vec![vec![Choice::Missing; clips.len()]; tags.len()];
    for (at, clip) in clips.iter().enumerate() {
        for (index, text) in (0..).zip(&clip.texts) {
            if let Some(column) = index_of.get(text.locale.as_ref()).and_then(|&locale| own.get_mut(locale)) {
                column[at] = Choice::Own(index);
            }
        }
    }
    let locales = tags.iter().enumerate().map(|(locale, tag)| {
        let chain = fallback::chain(&tags, locale, options);
        let choice = |(at, choice): (usize, &Choice)| match choice {
            Choice::Missing => chain
                .iter()
                .find(|&&other| own[other][at] != Choice::Missing)
                .map_or(Choice::Missing, |&other| Choice::Fallback(other as u32)),
            own => *own,
        };
        let texts = own[locale].iter().enumerate().map(choice).collect();
        LocaleColumn { tag: (*tag).to_owned(), is_default: Some(*tag) == default, texts }
    });
    Localised { locales: locales.collect() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn clip(locales: &[&str]) -> ClipData {
        let mut clip = ClipData { starts: vec![0], ..ClipData::default() };
        for tag in locales {
            clip.add_texts((*tag).into(), &[tag]);
        }
        clip
    }

    #[test]
    fn same_language_then_default() {
        let clips = [
            clip(&["de-at", "de-ch", "de-de", "en-us"]),
            clip(&["de-ch", "en-us"]),
            clip(&["en-us"]),
            clip(&["fr-fr"]),
        ];
        let options = Options { default_locale: Some("en-us".into()), ..Options::default() };
        let localised = localise(&clips, &options);
        let of = |tag: &str| &localised.locales.iter().find(|locale| locale.tag == tag).unwrap().texts;
        use Choice::{Fallback, Missing, Own};
        // de-at, de-ch, de-de, en-us, fr-fr
        assert_eq!(*of("de-at"), [Own(0), Fallback(1), Fallback(3), Missing]);
        assert_eq!(*of("de-ch"), [Own(1), Own(0), Fallback(3), Missing]);
        assert_eq!(*of("fr-fr"), [Fallback(3), Fallback(3), Fallback(3), Own(0)]);
        assert_eq!(*of("en-us"), [Own(3), Own(1), Own(0), Missing]);
    }
}
