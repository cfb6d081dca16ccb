//! Numbers for the locales of texts.

use foldhash::HashMap;

/// The locales found by a thread, by number.
///
/// Nearly every name of a text has occurred before. The properties of its locale are cached here, so that lists of
/// languages and countries are searched only once.
#[derive(Clone, Debug, Default)]
pub(crate) struct Locales {
    tags: Vec<Box<str>>,
    numbers: HashMap<Box<str>, KnownLocale>,
}

#[derive(Clone, Copy, Debug)]
struct KnownLocale {
    number: u32,
    is_clean: bool,
}

impl Locales {
    /// Returns the number of the locale with this tag. `is_clean` states that an element name with exactly this tag
    /// causes no diagnostic.
    pub(crate) fn number(&mut self, tag: &str, is_clean: bool) -> u32 {
        if let Some(known) = self.numbers.get_mut(tag) {
            known.is_clean |= is_clean;
            return known.number;
        }
        let number = self.tags.len() as u32;
        self.tags.push(tag.into());
        self.numbers.insert(tag.into(), KnownLocale { number, is_clean });
        number
    }

    /// Returns the number of a locale whose tag causes no diagnostic in the name of a text.
    pub(crate) fn clean(&self, tag: &str) -> Option<u32> {
        self.numbers.get(tag).filter(|known| known.is_clean).map(|known| known.number)
    }

    /// Returns the number of a locale that has occurred.
    pub(crate) fn get(&self, tag: &str) -> Option<u32> {
        self.numbers.get(tag).map(|known| known.number)
    }

    /// Returns the tag of a locale.
    pub(crate) fn tag(&self, number: u32) -> &str {
        &self.tags[number as usize]
    }

    /// Returns the tags of all locales, sorted by number.
    pub(crate) fn tags(&self) -> &[Box<str>] {
        &self.tags
    }
}
