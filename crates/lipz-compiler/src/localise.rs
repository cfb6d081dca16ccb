//! Locales of the bank, and which text each clip shows in each of them.

use crate::Options;
use crate::clip::Clip;
use crate::dubs::Dubs;
use crate::fallback::Fallbacks;

/// The locales of a bank with the texts of all clips.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Localised {
    /// In the order of their tags.
    pub(crate) locales: Vec<LocaleColumn>,
}

/// A locale, and what it shows of other texts than its own.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct LocaleColumn {
    pub(crate) tag: Box<str>,
    pub(crate) is_default: bool,
    /// For each clip, as far as there are any, a number for what it shows without a text of its own. Of millions of
    /// texts most are their clips' own.
    others: Vec<u32>,
}

/// What a clip without a text in a locale shows there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Other {
    /// The text of its original: it is a dub.
    Original,
    /// That of the locale with this index.
    Fallback(u32),
}

/// No text but the clip's own.
const NONE: u32 = u32::MAX;
/// The text of the original.
const ORIGINAL: u32 = u32::MAX - 1;

impl LocaleColumn {
    /// The column of a locale in which clips show their own texts.
    pub(crate) fn new(tag: &str, is_default: bool) -> LocaleColumn {
        LocaleColumn { tag: tag.into(), is_default, others: Vec::new() }
    }

    /// Has the clip with this index, which has no text in the locale, show another one, or none.
    pub(crate) fn set(&mut self, clip: usize, other: Option<Other>) {
        if clip >= self.others.len() && other.is_some() {
            self.others.resize(clip + 1, NONE);
        }
        if let Some(stored) = self.others.get_mut(clip) {
            *stored = match other {
                None => NONE,
                Some(Other::Original) => ORIGINAL,
                Some(Other::Fallback(locale)) => locale,
            };
        }
    }

    /// What the clip with this index shows, if it is not its own text.
    pub(crate) fn other(&self, clip: usize) -> Option<Other> {
        self.others.get(clip).copied().and_then(other)
    }

    /// All clips with another text than their own.
    pub(crate) fn others(&self) -> impl Iterator<Item = (usize, Other)> {
        self.others.iter().enumerate().filter_map(|(clip, stored)| Some((clip, other(*stored)?)))
    }
}

fn other(stored: u32) -> Option<Other> {
    match stored {
        NONE => None,
        ORIGINAL => Some(Other::Original),
        locale => Some(Other::Fallback(locale)),
    }
}

/// Resolves fallback for `clips`, whose texts refer to `tags`; [`chain`](crate::fallback::chain) has the rule. The texts of
/// an original are those of its dubs, too, where these have none.
pub(crate) fn localise(clips: &[Clip<'_>], tags: &[Box<str>], dubs: &Dubs, options: &Options) -> Localised {
    let mut localised = own(tags, options);
    let columns = &mut localised.locales;
    let has_text = |at: usize, locale: usize| clips[at].text_in(locale as u32).is_some();
    for (at, dub) in dubs.iter() {
        for (locale, column) in columns.iter_mut().enumerate() {
            if !has_text(at, locale) && has_text(dub.original, locale) {
                column.set(at, Some(Other::Original));
            }
        }
    }
    // A clip with texts in all locales needs none of others: usually that is every clip.
    let mut fallbacks = None;
    for (at, clip) in clips.iter().enumerate().filter(|(_, clip)| clip.texts().len() < tags.len()) {
        let fallbacks = fallbacks.get_or_insert_with(|| Fallbacks::new(tags, options));
        let own = clip.texts().iter().filter(|text| !text.is_fallback()).map(|text| text.locale as usize);
        let of_original = dubs.dub(at).into_iter().flat_map(|dub| clips[dub.original].texts());
        let borrowed = of_original.filter(|text| !text.is_fallback()).map(|text| text.locale as usize);
        let borrowed = borrowed.filter(|&locale| columns[locale].other(at) == Some(Other::Original));
        let own: Vec<usize> = own.chain(borrowed).collect();
        let is_missing = |locale: &usize| columns[*locale].other(at).is_none() && !has_text(at, *locale);
        let missing: Vec<usize> = (0..tags.len()).filter(is_missing).collect();
        fallbacks.resolve(own.into_iter(), missing.into_iter(), |locale, other| {
            columns[locale].set(at, Some(Other::Fallback(other as u32)));
        });
    }
    localised
}

/// The locales with these `tags` in which clips show the texts that they have themselves: nothing is resolved.
pub(crate) fn own(tags: &[Box<str>], options: &Options) -> Localised {
    let default = options.default_locale.as_deref();
    let locales = tags.iter().map(|tag| LocaleColumn::new(tag, Some(&**tag) == default));
    Localised { locales: locales.collect() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::clip::{ClipData, Clips};

    /// Localises clips with texts in these locales.
    fn localised(clips: &[&[&str]], default: Option<&str>) -> Localised {
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
        use Other::Fallback;
        // de-at, de-ch, de-de, en-us, fr-fr
        assert_eq!(of("de-at"), [(1, Fallback(1)), (2, Fallback(3))]);
        assert_eq!(of("de-ch"), [(2, Fallback(3))]);
        assert_eq!(of("fr-fr"), [(0, Fallback(3)), (1, Fallback(3)), (2, Fallback(3))]);
        assert_eq!(of("en-us"), []);
    }
}
