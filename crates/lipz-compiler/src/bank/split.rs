//! Splitting a bank by locale: a base bank without texts, and a text bank for each locale.

use crate::bank::lower::assemble::{Section, assemble};
use crate::bank::lower::numbering::Numbering;
use crate::bank::lower::texts::{Displays, TextRun, pool_of};
use crate::bank::lower::too_large;
use crate::clip::{ClipData, split_run};
use lipz_bank::{Bank, Locale};
use lipz_diagnostics::{Code, Report};
use lipz_file::locale::split_variant;
use lipz_layout::{Header, LOCALE_DEFAULT, LocaleRecord, NO_TEXT, TEXT_OFFSET, Tag, U32};
use zerocopy::{FromBytes, IntoBytes};

/// A bank, split by locale.
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub struct SplitBank {
    /// The bank without texts, locales and sources.
    pub base: Vec<u8>,
    /// Tag and text bank of each locale.
    pub texts: Vec<(String, Vec<u8>)>,
}

impl SplitBank {
    /// Splits a bank of the [`Compiler`](crate::Compiler). The text bank of a locale contains all texts that it shows,
    /// and their variants: where it falls back, the text of the other locale, marked as a fallback. Source records refer
    /// to texts of all locales and are left out.
    ///
    /// ```
    /// use lipz_compiler::{Compiler, Input, SplitBank};
    /// let file = br#"{ "visemes": "MA|EO", "text_en-us": "Mayor| !", "text_de-de": "Herr|Mayor!" }"#;
    /// let bank = Compiler::default().compile(&[Input::from_bytes("mayor", file)]).bank.ok_or("no bank")?;
    /// let split = SplitBank::from_bytes(&bank).map_err(|report| report.to_string())?;
    /// let (tag, german) = &split.texts[0];
    /// let mut base = lipz_bank::Bank::open(&split.base)?.verify()?;
    /// base.open_texts(german)?;
    /// let segment = base.clip_by_key("mayor").and_then(|clip| clip.segment(1)).ok_or("no clip")?;
    /// let text = base.locale(tag).and_then(|locale| segment.text(locale));
    /// assert_eq!(text.map(|text| text.as_str()), Some("Mayor!"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// If `bytes` are not a bank.
    pub fn from_bytes(bytes: &[u8]) -> Result<SplitBank, Report> {
        let whole = WholeBank::open(bytes)?;
        let texts = whole.locales().map(|locale| Ok((whole.tag(locale).to_owned(), whole.text_bank(locale)?)));
        Ok(SplitBank { texts: texts.collect::<Result<_, Report>>()?, base: whole.base()? })
    }
}

/// The most bytes of all texts of a locale, because their offsets have 31 bits. A text bank holds fewer.
const MAX_TEXTS_BYTES: usize = 1 << 30;

fn damaged() -> Report {
    Report::failure("", Code::BankDamaged, "the bank to split is damaged", "pack it again")
}

/// A bank that is split part by part. All parts together take as much memory as the bank.
pub(crate) struct WholeBank<'data> {
    bank: Bank<'data>,
    index_seed: u64,
}

impl<'data> WholeBank<'data> {
    /// # Errors
    /// If `bytes` are not a bank.
    pub(crate) fn open(bytes: &'data [u8]) -> Result<WholeBank<'data>, Report> {
        let bank = Bank::open(bytes).and_then(Bank::verify);
        let (Ok(bank), Ok((header, _))) = (bank, Header::ref_from_prefix(bytes)) else {
            return Err(damaged());
        };
        Ok(WholeBank { bank, index_seed: header.index_seed.get() })
    }

    /// Returns the locales, each of which gets a text bank. Variants are in that of their locale.
    pub(crate) fn locales(&self) -> impl Iterator<Item = Locale> {
        let has_bank = |tag: &str| match split_variant(tag) {
            (locale, Some(_)) => self.bank.locale(locale).is_none(),
            (_, None) => true,
        };
        self.bank.locales().filter(move |locale| has_bank(self.tag(*locale)))
    }

    /// Returns the tag of a locale.
    pub(crate) fn tag(&self, locale: Locale) -> &'data str {
        self.bank.locale_tag(locale)
    }

    /// Returns the contents of a section; empty if the bank lacks it.
    fn section(&self, tag: Tag) -> &'data [u8] {
        self.bank.sections().find(|(found, _)| *found == tag.0).map_or(&[], |(_, contents)| contents)
    }

    /// Returns the bank without locales, with all other sections that games read, unchanged.
    pub(crate) fn base(&self) -> Result<Vec<u8>, Report> {
        let names = self.section(Tag::NAMES);
        // Keys come first, without gaps.
        let keys_bytes = self.bank.clips().map(|clip| clip.key().len()).sum();
        let required = Tag::REQUIRED.map(|(tag, _)| match tag {
            Tag::LOCALES | Tag::TEXTS => Section::table(tag, &[]),
            Tag::TEXT_STARTS => Section::table(tag, &[0; size_of::<U32>()]),
            Tag::NAMES => Section::table(tag, names.get(..keys_bytes).unwrap_or(names)),
            other => Section::table(other, self.section(other)),
        });
        let kept = Tag::OPTIONAL.into_iter().filter(|section| section.is_in_base);
        let optional = kept.map(|section| (section.tag, self.section(section.tag)));
        let optional = optional.filter(|(_, contents)| !contents.is_empty());
        let sections: Vec<_> =
            required.into_iter().chain(optional.map(|(tag, contents)| Section::table(tag, contents))).collect();
        assemble(&sections, self.index_seed, self.bank.fingerprint(), |_| ())
    }

    /// Returns the text bank of a locale and its variants.
    pub(crate) fn text_bank(&self, locale: Locale) -> Result<Vec<u8>, Report> {
        let is_variant =
            |other: &Locale| matches!(split_variant(self.tag(*other)), (varied, Some(_)) if varied == self.tag(locale));
        let (mut names, mut records, mut starts, mut pool) = (String::new(), Vec::new(), Vec::new(), Vec::new());
        // Locales are sorted by tag, so that a locale comes before its variants.
        for of_bank in std::iter::once(locale).chain(self.bank.locales().filter(is_variant)) {
            let tag = self.tag(of_bank);
            records.push(LocaleRecord {
                tag_offset_bytes: (names.len() as u32).into(),
                tag_length_bytes: (tag.len() as u16).into(),
                flags: if self.bank.default_locale() == Some(of_bank) { LOCALE_DEFAULT } else { 0 }.into(),
            });
            names.push_str(tag);
            let (mut own_starts, own_pool) = self.pool(of_bank)?;
            if pool.len() + own_pool.len() > TEXT_OFFSET as usize {
                return Err(too_large("texts"));
            }
            let base = pool.len() as u32;
            own_starts.iter_mut().filter(|start| start.get() != NO_TEXT).for_each(|start| *start += base);
            // The end of the pool follows the starts of the last locale only.
            starts.truncate(starts.len().saturating_sub(1));
            starts.append(&mut own_starts);
            pool.extend_from_slice(&own_pool);
        }
        let sections = [
            Section::table(Tag::NAMES, names.as_bytes()),
            Section::table(Tag::LOCALES, records.as_bytes()),
            Section::table(Tag::TEXT_STARTS, starts.as_bytes()),
            Section::table(Tag::TEXTS, &pool),
        ];
        assemble(&sections, 0, self.bank.fingerprint(), |_| ())
    }

    /// Returns text starts and texts of a locale.
    fn pool(&self, locale: Locale) -> Result<(Vec<U32>, Vec<u8>), Report> {
        let numbering = Numbering::new(self.bank.clips().map(|clip| (clip.has_events(), clip.segment_count())));
        // Treat the texts of all clips as those of one, because the rest of a clip is not used.
        let mut texts = ClipData::default();
        let mut places: Vec<Option<u32>> = Vec::with_capacity(self.bank.clip_count());
        for found in self.bank.clips() {
            let own = || found.segments().map(|segment| segment.text_bytes(locale).unwrap_or_default());
            if texts.runs.byte_count() + own().map(<[u8]>::len).sum::<usize>() > MAX_TEXTS_BYTES {
                return Err(too_large("texts"));
            }
            let first = found.segment(0).and_then(|segment| segment.text(locale));
            places.push(first.map(|first| {
                texts.starts.resize(found.segment_count() as usize, 0);
                texts.add_texts(0, own(), first.is_fallback());
                texts.texts.len() as u32 - 1
            }));
        }
        pool_of(&numbering, |at| {
            let text = texts.texts.get(places[at]? as usize)?;
            let (displays, ends) = split_run(texts.whole_run(text), numbering.segments(at).len());
            Some(TextRun::new(text, ends, Displays::Here(displays), displays.is_empty()))
        })
    }
}
