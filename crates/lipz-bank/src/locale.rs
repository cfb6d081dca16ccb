//! The locales of a file: handles for text queries.

use crate::Bank;
use crate::file::{Sections, entries, place};
use crate::origin::Origin;
use crate::pool::Pool;
use crate::text::{FoundText, TextPlace};
use lipz_layout::{ClipRecord, LOCALE_DEFAULT, LocaleRecord, NO_TEXT, U32};
use lipz_types::hash::{FINISH, STEP, mix};

/// A locale of a [`Dialogue`](crate::Dialogue) or of a [`Bank`], for text queries.
///
/// Look it up once, with `locale("de-de")`, and keep it: it is two numbers that borrow nothing. Its tag is
/// `locale_tag(locale)`.
///
/// A locale belongs to the dialogue in which it was looked up. It leads to no text in another dialogue, or in another
/// version of the same dialogue: look it up again after a refresh.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Locale {
    /// The origin of the dialogue, and of the list that `index` refers to.
    pub(crate) origin: Origin,
    /// The file that contains the list.
    pub(crate) file: u16,
    pub(crate) index: u16,
}

impl Locale {
    /// Returns the handle as numbers, for a struct of another language.
    pub const fn to_words(self) -> [u32; 2] {
        [self.origin.to_u32(), (self.file as u32) << 16 | self.index as u32]
    }

    /// Returns the handle of [`Locale::to_words`]. Any numbers are accepted; invalid ones lead to no text.
    pub const fn from_words([origin, place]: [u32; 2]) -> Locale {
        Locale { origin: Origin::from_u32(origin), file: (place >> 16) as u16, index: place as u16 }
    }
}

/// Whether `tag` is that of a variant of a locale: `pl-pl-x-few` has the key `few`, and varies `pl-pl`.
fn is_variant(tag: &str, varied: &str, key: &str) -> bool {
    let behind = tag.strip_prefix(varied).and_then(|tag| tag.strip_prefix("-x-"));
    !varied.is_empty() && behind == Some(key)
}

/// Returns the variant of a locale among `tags` that a key finds, or the locale: the search is for the key, then for the
/// key without names from its end, and then for the same without a leading plural category.
pub(crate) fn variant_among<'t, I: Iterator<Item = (Locale, &'t str)>>(
    (locale, varied): (Locale, &str),
    key: &str,
    tags: impl Fn() -> I,
) -> Locale {
    let find = |key: &str| Some(tags().find(|(_, tag)| is_variant(tag, varied, key))?.0);
    let with_beginning = |mut key: &str| {
        loop {
            // The compiler keeps a panic in `str::rfind`, and the libraries for C and the web refuse to link one.
            match (find(key), key.bytes().rposition(is_hyphen)) {
                (Some(variant), _) => return Some(variant),
                (None, Some(end)) => key = key.get(..end)?,
                (None, None) => return None,
            }
        }
    };
    with_beginning(key).or_else(|| with_beginning(behind_category(key)?)).unwrap_or(locale)
}

/// Returns the names of a key behind a leading plural category of Unicode's CLDR: `fem` for `few-fem`.
fn behind_category(key: &str) -> Option<&str> {
    let end = key.bytes().position(is_hyphen)?;
    let (first, rest) = (key.get(..end)?, key.get(end.wrapping_add(1)..)?);
    if matches!(first, "zero" | "one" | "two" | "few" | "many" | "other") { Some(rest) } else { None }
}

fn is_hyphen(byte: u8) -> bool {
    byte == b'-'
}

/// The locales of a file with their texts: four of a bank's sections, and all sections of a text bank.
#[derive(Clone, Copy)]
pub(crate) struct LocaleTable<'data> {
    pub(crate) records: &'data [LocaleRecord],
    pub(crate) names: Pool<'data>,
    /// For each locale in turn, one entry per segment, and a final one.
    pub(crate) starts: &'data [U32],
    pub(crate) texts: Pool<'data>,
    pub(crate) segment_count: usize,
}

impl<'data> LocaleTable<'data> {
    /// Returns the table of a file whose clips have this number of segments.
    pub(crate) fn new(sections: &Sections<'data>, segment_count: usize) -> LocaleTable<'data> {
        LocaleTable {
            records: entries(sections[place::LOCALES]),
            names: Pool::Bytes(sections[place::NAMES]),
            starts: entries(sections[place::TEXT_STARTS]),
            texts: Pool::Bytes(sections[place::TEXTS]),
            segment_count,
        }
    }

    /// Returns the tag of the locale with this index, without a UTF-8 check.
    pub(crate) fn tag_bytes(&self, index: usize) -> Option<&'data [u8]> {
        let record = self.records.get(index)?;
        let start = record.tag_offset_bytes.get() as usize;
        self.names.slice(start, start.checked_add(usize::from(record.tag_length_bytes.get()))?)
    }

    /// Returns the tag of the locale with this index.
    pub(crate) fn tag(&self, index: usize) -> Option<&'data str> {
        let record = self.records.get(index)?;
        self.names.text_at(record.tag_offset_bytes.get(), u32::from(record.tag_length_bytes.get()))
    }

    /// Returns the index of the locale with this tag.
    pub(crate) fn index_of(&self, tag: &[u8]) -> Option<usize> {
        (0..self.records.len()).find(|&index| self.tag_bytes(index) == Some(tag))
    }

    /// Returns the index of the default locale, if one is marked.
    pub(crate) fn default_index(&self) -> Option<usize> {
        self.records.iter().position(|record| record.flags.get() & LOCALE_DEFAULT != 0)
    }

    /// Returns a hash of the tags in their order. Equal lists have equal hashes.
    pub(crate) fn list_hash(&self) -> u32 {
        let mut hash = self.records.len() as u64;
        for index in 0..self.records.len() {
            for &byte in self.tag_bytes(index).unwrap_or(&[]) {
                hash = mix(hash ^ u64::from(byte), STEP);
            }
            hash = mix(hash, FINISH);
        }
        (hash >> 32) as u32
    }

    /// Returns the text of a segment in the locale with this index. `first` is the number of the clip's first segment,
    /// and `number` that of the segment.
    #[inline(always)]
    pub(crate) fn find(&'data self, index: usize, first: usize, number: usize) -> Option<FoundText<'data>> {
        let list = index.wrapping_mul(self.segment_count);
        let (first, number) = (list.wrapping_add(first), list.wrapping_add(number));
        // A clip has texts in all of its segments or in none. Its first entry is usually in the same cache line as that
        // of the segment, so the processor fetches it while it searches for the segment.
        if self.starts.get(first)?.get() == NO_TEXT {
            return None;
        }
        match self.starts.get(number..number.wrapping_add(2))? {
            [start, next] => {
                let place = TextPlace::between(*start, *next, self.texts)?;
                Some(FoundText { place, texts: &self.texts })
            }
            _ => None,
        }
    }
}

impl<'data> Bank<'data> {
    /// Returns the locale with this tag, spelled as in the bank (`en-us`). Look it up once and pass it to text queries.
    pub fn locale(&self, tag: &str) -> Option<Locale> {
        Some(self.numbered_locale(self.texts.index_of(tag.as_bytes())?))
    }

    /// Returns the default locale, if one was set when the bank was packed.
    pub fn default_locale(&self) -> Option<Locale> {
        Some(self.numbered_locale(self.texts.default_index()?))
    }

    /// Returns all locales of the bank, ordered by tag.
    pub fn locales(&self) -> impl ExactSizeIterator<Item = Locale> + Clone + '_ {
        (0..self.texts.records.len() as u32).map(move |index| self.numbered_locale(index as usize))
    }

    /// Returns the tag of a locale, as in `text_en-us` of a Lipz file: `en-us`. Empty for a locale of another bank, and
    /// in a damaged bank.
    pub fn locale_tag(&self, locale: Locale) -> &'data str {
        let tag = if locale.origin == self.origin { self.texts.tag(usize::from(locale.index)) } else { None };
        tag.unwrap_or("")
    }

    /// Returns the locale for texts of a variant: for `pl-pl` and the key `few`, the texts of `text_pl-pl-x-few` in
    /// Lipz files. Clips without the variant show their text in the locale.
    ///
    /// A key lists all cases that apply, the plural category first: `few`, or `few-fem`. The search removes names from
    /// the end of the key (`few-fem`, `few`), and then does the same without the plural category (`fem`). If no clip
    /// has any of these, the result is the locale itself. Look variants up once per locale.
    pub fn variant(&self, locale: Locale, key: &str) -> Locale {
        let tags = || self.locales().map(|other| (other, self.locale_tag(other)));
        variant_among((locale, self.locale_tag(locale)), key, tags)
    }

    /// Returns the text of the segment with this index of a clip of the bank, if the locale belongs to the bank.
    #[inline(always)]
    pub(crate) fn text_of(&'data self, clip: &ClipRecord, segment: u32, locale: Locale) -> Option<FoundText<'data>> {
        if locale.origin != self.origin {
            return None;
        }
        let first = clip.segments_first.get() as usize;
        self.texts.find(usize::from(locale.index), first, first.wrapping_add(segment as usize))
    }

    /// Returns the handle of the locale with this index.
    fn numbered_locale(&self, index: usize) -> Locale {
        Locale { origin: self.origin, file: 0, index: index as u16 }
    }
}
