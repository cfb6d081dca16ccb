//! The locales of a dialogue: looked up once, and found in the table of each file that contains them.

use super::file::Contents;
use super::stack::{ClipLocation, Level};
use super::{Answers, Base, Dialogue, Layer};
use crate::locale::{LocaleTable, variant_among};
use crate::text::FoundText;
use crate::{Bank, Locale};
use lipz_layout::{ClipRecord, LAYER_DEFAULT_LOCALE};

/// The locales in a file.
#[derive(Clone, Copy)]
struct FileLocales<'a> {
    /// The number of the file.
    number: usize,
    locales: &'a LocaleTable<'a>,
    /// The hash of the list of its locales.
    list: u32,
}

/// A locale in a table of texts.
#[derive(Clone, Copy)]
struct InTable<'a> {
    table: &'a LocaleTable<'a>,
    index: usize,
    /// Whether it replaces the requested locale.
    stands_in: bool,
}

impl<'a> Dialogue<'a> {
    /// Returns the locale with this tag, spelled as in the files (`en-us`). Look it up once and pass it to text
    /// queries.
    ///
    /// Clips of files without the locale show the text of the locale that it falls back to, marked as a
    /// [fallback](crate::Text::is_fallback).
    pub fn locale(&self, tag: &str) -> Option<Locale> {
        match self.answers {
            Answers::Alone(bank) => bank.locale(tag),
            Answers::Together(queries) => (queries.locale)(self, tag),
        }
    }

    pub(super) fn locale_in_files(&self, tag: &str) -> Option<Locale> {
        let mut patches = (0..self.patch_count).rev().filter_map(|patch| self.patch(patch));
        let mut found = None;
        for level in &mut patches {
            found = found.or_else(|| self.handle_in(level, tag));
            if level.layer.map_or(false, |layer| layer.removes_locale(tag)) {
                return found;
            }
        }
        // Most clips use the base's list. For these, a locale is then an index in a table.
        self.base_levels().find_map(|level| self.handle_in(level, tag)).or(found)
    }

    /// Returns the default locale, from the topmost file that sets one. If a bank has no locales, its text banks set
    /// it.
    pub fn default_locale(&self) -> Option<Locale> {
        match self.answers {
            Answers::Alone(bank) => bank.default_locale(),
            Answers::Together(queries) => (queries.default_locale)(self),
        }
    }

    pub(super) fn default_locale_in_files(&self) -> Option<Locale> {
        let bank = self.bank_with_in_files(LAYER_DEFAULT_LOCALE)?;
        let number = bank.number as usize;
        let level = Level { number, file: self.bank_file(number)?, layer: None };
        let tag = self.tables_of(level).find_map(|table| table.locales.tag(table.locales.default_index()?))?;
        self.locale(tag)
    }

    /// Returns all locales of the dialogue, in any order.
    pub fn locales(&self) -> impl Iterator<Item = Locale> + '_ {
        self.locale_tags().filter_map(move |tag| self.locale(tag))
    }

    /// Returns the tag of a locale, as in `text_en-us` of a Lipz file: `en-us`. Empty for a locale of another dialogue,
    /// and in a damaged file.
    pub fn locale_tag(&self, locale: Locale) -> &'a str {
        match self.answers {
            Answers::Alone(bank) => bank.locale_tag(locale),
            Answers::Together(queries) => (queries.locale_tag)(self, locale),
        }
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

    /// Returns the tags of all locales, each once, those of the topmost file first.
    fn locale_tags(&self) -> impl Iterator<Item = &'a str> + '_ {
        let levels = move || {
            let patches = (0..self.patch_count).rev().filter_map(move |patch| self.patch(patch));
            patches.chain(self.base_levels())
        };
        levels().enumerate().flat_map(move |(depth, level)| {
            let is_new = move |tag: &&str| {
                let removes = |layer: &Layer<'_>| layer.removes_locale(tag);
                let has = |level: Level<'a>| self.handle_in(level, tag).is_some() || level.layer.map_or(false, removes);
                !levels().take(depth).any(has)
            };
            self.tags_of(level).filter(is_new)
        })
    }

    /// Returns the tags of the locales of a bank and of its text banks, each once.
    fn tags_of(&self, level: Level<'a>) -> impl Iterator<Item = &'a str> + '_ {
        self.tables_of(level).enumerate().flat_map(move |(place, table)| {
            let is_new = move |tag: &&str| {
                let has = |table: FileLocales<'_>| table.locales.index_of(tag.as_bytes()).is_some();
                !self.tables_of(level).take(place).any(has)
            };
            (0..table.locales.records.len()).filter_map(move |index| table.locales.tag(index)).filter(is_new)
        })
    }

    /// Returns the text of the segment with this index of a clip, from any file. The clip's bank may contain its texts.
    #[inline(always)] // into both queries
    pub(super) fn text_of(
        &'a self,
        bank: &'a Bank<'a>,
        record: &'a ClipRecord,
        (segment, has_texts): (u32, bool),
        locale: Locale,
    ) -> Option<FoundText<'a>> {
        let is_in_table = locale.origin == self.origin.with_list(bank.locale_list);
        if is_in_table && has_texts && !self.removes_locales {
            return text_in(&bank.texts, usize::from(locale.index), record, segment);
        }
        self.text_elsewhere(bank.slot_of(record), bank, (segment, has_texts), locale)
    }

    /// Returns the text of a segment of a clip whose bank lacks the locale or the texts.
    #[inline(never)]
    fn text_elsewhere(
        &'a self,
        slot: u32,
        bank: &'a Bank<'a>,
        (segment, has_texts): (u32, bool),
        locale: Locale,
    ) -> Option<FoundText<'a>> {
        let list = self.list_of(locale)?;
        let tag = list.tag_bytes(usize::from(locale.index))?;
        let place = match has_texts {
            true => ClipLocation { file: bank.number, slot },
            false => self.texts_place(bank.clip_at(slot)?.id())?,
        };
        let file = self.bank_file(place.file as usize)?;
        let level = Level { number: place.file as usize, file, layer: None };
        let in_table = self.in_table_of(level, locale, tag)?;
        let clip = file.bank.clip_at(place.slot)?;
        if segment >= clip.segment_count() {
            return None;
        }
        let found = text_in(in_table.table, in_table.index, clip.record, segment)?;
        Some(found.marked(in_table.stands_in))
    }

    /// Returns the locale whose texts the clips of a bank of the stack show.
    fn in_table_of(&self, asked: Level<'a>, locale: Locale, tag: &[u8]) -> Option<InTable<'a>> {
        if self.patch_count == 0 {
            // Usually, the requested locale is in the file that the handle names.
            let named = match self.files.file(usize::from(locale.file)).map(|named| &named.contents) {
                Some(Contents::Texts(texts)) if texts.is_beside(&asked.file.bank) => Some(&texts.table),
                _ => None,
            };
            if let (Some(table), None) = (named, asked.file.bank.texts.index_of(tag)) {
                return Some(InTable { table, index: usize::from(locale.index), stands_in: false });
            }
            return self.own_of(asked, tag);
        }
        // From the top: a patch names replacements for its locales in banks below it, and removes locales of these
        // banks.
        let mut stand_in: Option<&'a [u8]> = None;
        let mut is_removed = false;
        let patches = (0..self.patch_count).rev().filter_map(|patch| self.patch(patch));
        for level in patches.chain(Some(asked)) {
            let own = if is_removed { None } else { self.own_of(level, tag) };
            let other = || Some(InTable { stands_in: true, ..self.own_of(level, stand_in?)? });
            let found = own.or_else(other);
            if level.number == asked.number {
                return found;
            }
            let layer = level.layer?;
            let below = |tag| {
                let table = &level.file.bank.texts;
                table.tag_bytes(layer.stand_in(table.index_of(tag)?)?)
            };
            stand_in = match own {
                Some(_) => below(tag),
                // The replacement may itself be new in this file, and have a replacement below it.
                None => found.and(stand_in).and_then(below).or(stand_in),
            };
            let removes = |tag: &[u8]| layer.removed_locales().any(|removed| removed.as_bytes() == tag);
            is_removed |= removes(tag);
            // A later locale with the same tag is a different locale.
            stand_in = stand_in.filter(|other| !removes(other));
        }
        None
    }

    /// Returns the locale with this tag in a bank, or in one of its text banks.
    fn own_of(&self, level: Level<'a>, tag: &[u8]) -> Option<InTable<'a>> {
        self.tables_of(level).find_map(|table| {
            Some(InTable { table: table.locales, index: table.locales.index_of(tag)?, stands_in: false })
        })
    }

    /// Returns the table of a bank, and those of its text banks.
    fn tables_of(&self, level: Level<'a>) -> impl Iterator<Item = FileLocales<'a>> + Clone + '_ {
        let own =
            FileLocales { number: level.number, locales: &level.file.bank.texts, list: level.file.bank.locale_list };
        let numbers = self.behind_base()..self.files.count();
        let texts = numbers.filter_map(move |number| match &self.files.file(number)?.contents {
            Contents::Texts(texts) if texts.is_beside(&level.file.bank) => {
                Some(FileLocales { number, locales: &texts.table, list: texts.locale_list })
            }
            _ => None,
        });
        core::iter::once(own).chain(texts)
    }

    /// Returns the handle of the locale with this tag in a bank of the stack, or in one of its text banks.
    fn handle_in(&self, level: Level<'a>, tag: &str) -> Option<Locale> {
        self.tables_of(level).find_map(|table| {
            let index = u16::try_from(table.locales.index_of(tag.as_bytes())?).ok()?;
            Some(Locale { origin: self.origin.with_list(table.list), file: table.number as u16, index })
        })
    }

    /// Returns the list in which a locale is numbered; `None` for a locale of another dialogue.
    pub(super) fn list_of(&self, locale: Locale) -> Option<&'a LocaleTable<'a>> {
        let (table, list) = match &self.files.file(usize::from(locale.file))?.contents {
            Contents::Bank(file) => (&file.bank.texts, file.bank.locale_list),
            Contents::Texts(texts) => (&texts.table, texts.locale_list),
            _ => return None,
        };
        if locale.origin == self.origin.with_list(list) { Some(table) } else { None }
    }

    /// Returns the base, or the first loaded bank of a set. All banks of a set have the same locales and profiles.
    pub(super) fn base_levels(&self) -> impl Iterator<Item = Level<'a>> + Clone + '_ {
        let numbers = match &self.base {
            Base::Bank(_) => 0..1,
            Base::Set(_) => 1..self.behind_base(),
        };
        let levels = numbers.filter_map(move |number| {
            let file = self.bank_file(number)?;
            Some(Level { number, file, layer: None })
        });
        levels.take(1)
    }
}

/// Returns the text of a segment of the clip with this record, in the locale with this index of a table.
#[inline(always)]
fn text_in<'t>(table: &'t LocaleTable<'t>, index: usize, record: &ClipRecord, segment: u32) -> Option<FoundText<'t>> {
    let first = record.segments_first.get() as usize;
    table.find(index, first, first.wrapping_add(segment as usize))
}
