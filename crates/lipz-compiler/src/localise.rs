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

/// The texts of one locale.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct LocaleColumn {
    pub(crate) tag: Box<str>,
    pub(crate) is_default: bool,
    /// For each clip: where its text is.
    texts: Vec<Stored>,
}

/// A [`Choice`] as one number: there are millions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Stored(u32);

/// No text anywhere.
const MISSING: u32 = u32::MAX;
/// The text of the original.
const ORIGINAL: u32 = u32::MAX - 1;
/// A bit of the numbers of other locales.
const FALLBACK: u32 = 1 << 31;

impl Stored {
    fn new(choice: Choice) -> Stored {
        Stored(match choice {
            Choice::Own(index) => index,
            Choice::Fallback(other) => other | FALLBACK,
            Choice::Original => ORIGINAL,
            Choice::Missing => MISSING,
        })
    }

    fn choice(self) -> Choice {
        match self.0 {
            ORIGINAL => Choice::Original,
            MISSING => Choice::Missing,
            number if number & FALLBACK != 0 => Choice::Fallback(number & !FALLBACK),
            index => Choice::Own(index),
        }
    }
}

impl LocaleColumn {
    /// The column of a locale whose texts are there.
    pub(crate) fn new(tag: &str, is_default: bool, texts: impl Iterator<Item = Choice>) -> LocaleColumn {
        LocaleColumn { tag: tag.into(), is_default, texts: texts.map(Stored::new).collect() }
    }

    /// Puts the text of the clip with this index elsewhere.
    pub(crate) fn set(&mut self, clip: usize, choice: Choice) {
        if let Some(stored) = self.texts.get_mut(clip) {
            *stored = Stored::new(choice);
        }
    }

    /// Where the text of the clip with this index is.
    pub(crate) fn text(&self, clip: usize) -> Choice {
        self.texts.get(clip).map_or(Choice::Missing, |stored| stored.choice())
    }

    /// Where the text of each clip is.
    pub(crate) fn texts(&self) -> impl Iterator<Item = Choice> {
        self.texts.iter().map(|stored| stored.choice())
    }
}

/// Where the text of a clip in a locale is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Choice {
    /// The clip has a text in the locale: its index in `Clip::texts`.
    Own(u32),
    /// The clip is a dub without a text in the locale, and its original has one.
    Original,
    /// It does not, and shows that of the locale with this index.
    Fallback(u32),
    /// Nor in any locale that this one falls back to.
    Missing,
}

/// Resolves fallback for `clips`, whose texts refer to `tags`; [`chain`](crate::fallback::chain) has the rule. The texts of
/// an original are those of its dubs, too, where these have none.
pub(crate) fn localise(clips: &[Clip<'_>], tags: &[Box<str>], dubs: &Dubs, options: &Options) -> Localised {
    let mut choices = vec![vec![Stored::new(Choice::Missing); clips.len()]; tags.len()];
    for (at, clip) in clips.iter().enumerate() {
        for (index, text) in (0..).zip(clip.texts()) {
            choices[text.locale as usize][at] = Stored::new(Choice::Own(index));
        }
    }
    for (at, dub) in dubs.iter() {
        for of_locale in &mut choices {
            if let (Choice::Missing, Choice::Own(_)) = (of_locale[at].choice(), of_locale[dub.original].choice()) {
                of_locale[at] = Stored::new(Choice::Original);
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
        let borrowed = borrowed.filter(|&locale| choices[locale][at].choice() == Choice::Original);
        let own: Vec<usize> = own.chain(borrowed).collect();
        let missing: Vec<usize> =
            (0..tags.len()).filter(|&locale| choices[locale][at].choice() == Choice::Missing).collect();
        fallbacks.resolve(own.into_iter(), missing.into_iter(), |locale, other| {
            choices[locale][at] = Stored::new(Choice::Fallback(other as u32));
        });
    }
    columns(tags, choices, options)
}

/// The texts that `clips` have themselves, which refer to `tags`: nothing is resolved.
#[cfg(feature = "shards")]
pub(crate) fn own(clips: &[Clip<'_>], tags: &[Box<str>], options: &Options) -> Localised {
    let mut choices = vec![vec![Stored::new(Choice::Missing); clips.len()]; tags.len()];
    for (at, clip) in clips.iter().enumerate() {
        for (index, text) in (0..).zip(clip.texts()) {
            choices[text.locale as usize][at] = Stored::new(Choice::Own(index));
        }
    }
    columns(tags, choices, options)
}

fn columns(tags: &[Box<str>], choices: Vec<Vec<Stored>>, options: &Options) -> Localised {
    let default = options.default_locale.as_deref();
    let locales = std::iter::zip(tags, choices).map(|(tag, texts)| LocaleColumn {
        tag: tag.clone(),
        is_default: Some(tag.as_ref()) == default,
        texts,
    });
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
            column.texts().collect::<Vec<_>>()
        };
        use Choice::{Fallback, Missing, Own};
        // de-at, de-ch, de-de, en-us, fr-fr
        assert_eq!(of("de-at"), [Own(0), Fallback(1), Fallback(3), Missing]);
        assert_eq!(of("de-ch"), [Own(1), Own(0), Fallback(3), Missing]);
        assert_eq!(of("fr-fr"), [Fallback(3), Fallback(3), Fallback(3), Own(0)]);
        assert_eq!(of("en-us"), [Own(3), Own(1), Own(0), Missing]);
    }
}
