//! Locales of the bank, and the text that each clip shows in each of them.

use crate::clip::Clip;
use crate::locales::dubs::Dubs;
use crate::locales::fallback::Fallbacks;
use crate::project::Options;

/// The locales of a bank, with the texts that all clips show in them.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct LocalisedTexts {
    /// Sorted by tag.
    pub(crate) locales: Vec<LocaleColumn>,
}

/// A locale, and the texts that it shows in place of missing ones.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct LocaleColumn {
    pub(crate) tag: Box<str>,
    pub(crate) is_default: bool,
    /// For each clip, as far as necessary, a number for the text it shows without one of its own. Most of the millions
    /// of texts are own ones.
    others: Vec<u32>,
}

/// The text that a clip shows in a locale without a text of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum TextSubstitute {
    /// The text of its original, because it is a dub.
    Original,
    /// The text in the locale with this index.
    Fallback(u32),
}

/// No text except the clip's own.
const NONE: u32 = u32::MAX;
/// The text of the original.
const ORIGINAL: u32 = u32::MAX - 1;

impl LocaleColumn {
    /// Creates the column of a locale in which clips show only their own texts.
    pub(crate) fn new(tag: &str, is_default: bool) -> LocaleColumn {
        LocaleColumn { tag: tag.into(), is_default, others: Vec::new() }
    }

    /// Sets the text that the clip with this index, which has none of its own, shows in the locale.
    pub(crate) fn set(&mut self, clip: usize, other: Option<TextSubstitute>) {
        if clip >= self.others.len() && other.is_some() {
            self.others.resize(clip + 1, NONE);
        }
        if let Some(stored) = self.others.get_mut(clip) {
            *stored = match other {
                None => NONE,
                Some(TextSubstitute::Original) => ORIGINAL,
                Some(TextSubstitute::Fallback(locale)) => locale,
            };
        }
    }

    /// Returns the text that the clip with this index shows, if it is not its own.
    pub(crate) fn other(&self, clip: usize) -> Option<TextSubstitute> {
        self.others.get(clip).copied().and_then(other)
    }

    /// Returns all clips that show a text other than their own.
    pub(crate) fn others(&self) -> impl Iterator<Item = (usize, TextSubstitute)> {
        self.others.iter().enumerate().filter_map(|(clip, stored)| Some((clip, other(*stored)?)))
    }
}

fn other(stored: u32) -> Option<TextSubstitute> {
    match stored {
        NONE => None,
        ORIGINAL => Some(TextSubstitute::Original),
        locale => Some(TextSubstitute::Fallback(locale)),
    }
}

/// Resolves fallback for `clips`, whose texts refer to `tags`, by the rule of
/// [`chain`](crate::locales::fallback::chain). Dubs without texts show those of their original.
pub(crate) fn localise(clips: &[Clip<'_>], tags: &[Box<str>], dubs: &Dubs, options: &Options) -> LocalisedTexts {
    let mut localised = own(tags, options);
    let columns = &mut localised.locales;
    let has_text = |at: usize, locale: usize| clips[at].text_in(locale as u32).is_some();
    for (at, dub) in dubs.iter() {
        for (locale, column) in columns.iter_mut().enumerate() {
            if !has_text(at, locale) && has_text(dub.original, locale) {
                column.set(at, Some(TextSubstitute::Original));
            }
        }
    }
    // A clip with texts in all locales needs no fallback. Usually, that is every clip.
    let mut fallbacks = None;
    for (at, clip) in clips.iter().enumerate().filter(|(_, clip)| clip.texts().len() < tags.len()) {
        let fallbacks = fallbacks.get_or_insert_with(|| Fallbacks::new(tags, options));
        let own = clip.texts().iter().filter(|text| !text.is_fallback()).map(|text| text.locale as usize);
        let of_original = dubs.dub(at).into_iter().flat_map(|dub| clips[dub.original].texts());
        let borrowed = of_original.filter(|text| !text.is_fallback()).map(|text| text.locale as usize);
        let borrowed = borrowed.filter(|&locale| columns[locale].other(at) == Some(TextSubstitute::Original));
        let own: Vec<usize> = own.chain(borrowed).collect();
        let is_missing = |locale: &usize| columns[*locale].other(at).is_none() && !has_text(at, *locale);
        let missing: Vec<usize> = (0..tags.len()).filter(is_missing).collect();
        fallbacks.resolve(own.into_iter(), missing.into_iter(), |locale, other| {
            columns[locale].set(at, Some(TextSubstitute::Fallback(other as u32)));
        });
    }
    localised
}

/// Returns the locales with these `tags`, in which clips show only their own texts, without resolving fallback.
pub(crate) fn own(tags: &[Box<str>], options: &Options) -> LocalisedTexts {
    let default = options.default_locale.as_deref();
    let locales = tags.iter().map(|tag| LocaleColumn::new(tag, Some(&**tag) == default));
    LocalisedTexts { locales: locales.collect() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::clip::{ClipData, Clips};

    /// Localises clips with texts in these locales.
    fn localised(clips: &[&[&str]], default: Option<&str>) -> LocalisedTexts {
        let mut store = Clips::default();
        for (key, tags) in ('a'..).zip(clips) {
            let mut clip = ClipData { starts: vec![0], ..ClipData::default() };
            clip.displays.push("");
            for tag in *tags {
                clip.add_displays(store.locales.number(tag, true));
            }
            store.push(&key.to_string(), &clip);
        }
        let mut batches = [store];
        let tags = Clips::join_locales(&mut batches);
        let options = Options { default_locale: default.map(Into::into), ..Options::default() };
        localise(&Clips::by_key(&batches), &tags, &Dubs::default(), &options)
    }

    #[test]
    fn same_language_then_default() {
        let clips: [&[&str]; 4] = [&["de-at", "de-ch", "de-de", "en-us"], &["de-ch", "en-us"], &["en-us"], &["fr-fr"]];
        let localised = localised(&clips, Some("en-us"));
        let of = |tag: &str| {
            let column = localised.locales.iter().find(|locale| *locale.tag == *tag).unwrap();
            column.others().collect::<Vec<_>>()
        };
        use TextSubstitute::Fallback;
        // de-at, de-ch, de-de, en-us, fr-fr
        assert_eq!(of("de-at"), [(1, Fallback(1)), (2, Fallback(3))]);
        assert_eq!(of("de-ch"), [(2, Fallback(3))]);
        assert_eq!(of("fr-fr"), [(0, Fallback(3)), (1, Fallback(3)), (2, Fallback(3))]);
        assert_eq!(of("en-us"), []);
    }
}
