//! Numbers for the locales of texts.

use foldhash::HashMap;

/// The locales that a thread has met, by number.
///
/// Nearly every name of a text is one that was seen before: what was found about its locale then is
/// remembered here, so that lists of languages and countries are asked once.
#[derive(Clone, Debug, Default)]
pub(crate) struct Locales {
    tags: Vec<Box<str>>,
    numbers: HashMap<Box<str>, Known>,
}

#[derive(Clone, Copy, Debug)]
struct Known {
    number: u32,
    is_clean: bool,
}

impl Locales {
    /// The number of the locale with this tag. `is_clean` says that the name of a text which spells
    /// just this tag gives no diagnostic.
    pub(crate) fn number(&mut self, tag: &str, is_clean: bool) -> u32 {
        if let Some(known) = self.numbers.get_mut(tag) {
            known.is_clean |= is_clean;
            return known.number;
        }
        let number = self.tags.len() as u32;
        self.tags.push(tag.into());
        self.numbers.insert(tag.into(), Known { number, is_clean });
        number
    }

    /// The number of a locale whose tag gives no diagnostic in the name of a text.
    pub(crate) fn clean(&self, tag: &str) -> Option<u32> {
        self.numbers.get(tag).filter(|known| known.is_clean).map(|known| known.number)
    }

    /// The number of a locale that was met.
    pub(crate) fn get(&self, tag: &str) -> Option<u32> {
        self.numbers.get(tag).map(|known| known.number)
    }

    /// The tag of a locale.
    pub(crate) fn tag(&self, number: u32) -> &str {
        &self.tags[number as usize]
    }

    /// The tags of all locales, in the order of their numbers.
    pub(crate) fn tags(&self) -> &[Box<str>] {
        &self.tags
    }
}
