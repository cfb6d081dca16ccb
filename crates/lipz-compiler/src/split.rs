//! Splitting a bank by locale: a base bank without texts, and a text bank for each locale.

use crate::clip::{ClipData, Clips};
use crate::lower::assemble::{Section, assemble};
use crate::lower::texts::pool_of;
use lipz_bank::{Bank, Locale};
use lipz_diagnostics::{Code, Report};
use lipz_layout::{Header, LOCALE_DEFAULT, LocaleRecord, Tag, U32};
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
    /// Splits a bank of the [`Compiler`](crate::Compiler). The text bank of a locale holds all that a
    /// player of that locale reads: where the locale falls back, the text of the other one, marked as a
    /// fallback. Source records refer to texts of all locales and are left out.
    ///
    /// ```
    /// use lipz_compiler::{Compiler, Input, SplitBank};
    /// let file = br#"{ "visemes": "MA|EO", "text_en-us": "Mayor| !", "text_de-de": "Herr|Mayor!" }"#;
    /// let bank = Compiler::default().compile(&[Input::from_bytes("mayor", file)]).bank.ok_or("no bank")?;
    /// let split = SplitBank::from_bytes(&bank).map_err(|report| report.to_string())?;
    /// let (tag, german) = &split.texts[0];
    /// let base = lipz_bank::Bank::open(&split.base)?.verify()?;
    /// let texts = base.open_texts(german)?.verify(&base)?;
    /// let segment = base.clip_by_key("mayor").and_then(|clip| clip.segment(1)).ok_or("no clip")?;
    /// let text = texts.locale(tag).and_then(|locale| segment.text(locale));
    /// assert_eq!(text.map(|text| text.as_str()), Some("Mayor!"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// If `bytes` are not a bank.
    pub fn from_bytes(bytes: &[u8]) -> Result<SplitBank, Report> {
        let bank = Bank::open(bytes).and_then(Bank::verify);
        let (Ok(bank), Ok((header, _))) = (bank, Header::ref_from_prefix(bytes)) else {
            return Err(damaged());
        };
        let whole = WholeBank { bank, index_seed: header.index_seed.get() };
        let texts = (whole.bank.locales())
            .map(|locale| Ok((locale.tag().to_owned(), whole.text_bank(locale)?)))
            .collect::<Result<_, Report>>()?;
        Ok(SplitBank { base: whole.base()?, texts })
    }
}

fn damaged() -> Report {
    Report::failure("", Code::BankDamaged, "the bank to be split is damaged", "pack it again")
}

/// The bank that is split.
struct WholeBank<'data> {
    bank: Bank<'data>,
    index_seed: u64,
}

impl<'data> WholeBank<'data> {
    /// The contents of a section; empty if the bank does not have it.
    fn section(&self, tag: Tag) -> &'data [u8] {
        self.bank.sections().find(|(found, _)| *found == tag.0).map_or(&[], |(_, contents)| contents)
    }

    /// The bank without locales: all other sections that games read as they are.
    fn base(&self) -> Result<Vec<u8>, Report> {
        let names = self.section(Tag::NAMES);
        // Keys come first, in one piece.
        let keys_bytes = self.bank.clips().map(|clip| clip.key().len()).sum();
        let required = Tag::REQUIRED.map(|(tag, _)| match tag {
            Tag::LOCALES | Tag::TEXTS => Section::table(tag, &[]),
            Tag::TEXT_STARTS => Section::table(tag, &[0; size_of::<U32>()]),
            Tag::NAMES => Section::table(tag, names.get(..keys_bytes).unwrap_or(names)),
            other => Section::table(other, self.section(other)),
        });
        let optional = [Tag::BABBLE, Tag::RECORDINGS, Tag::CURVE_CLIPS, Tag::CURVES, Tag::CURVE_KEYS]
            .map(|tag| (tag, self.section(tag)));
        let optional = optional.into_iter().filter(|(_, contents)| !contents.is_empty());
        let sections: Vec<_> =
            required.into_iter().chain(optional.map(|(tag, contents)| Section::table(tag, contents))).collect();
        assemble(&sections, self.index_seed, self.bank.fingerprint(), |_| ())
    }

    /// The text bank of a locale.
    fn text_bank(&self, locale: Locale<'data>) -> Result<Vec<u8>, Report> {
        let clips = self.clips(locale);
        let (starts, pool) = pool_of(&clips.iter().collect::<Vec<_>>(), |_| false)?;
        let tag = locale.tag();
        let record = LocaleRecord {
            tag_offset_bytes: 0.into(),
            tag_length_bytes: (tag.len() as u16).into(),
            flags: if locale.is_default() { LOCALE_DEFAULT } else { 0 }.into(),
        };
        let sections = [
            Section::table(Tag::NAMES, tag.as_bytes()),
            Section::table(Tag::LOCALES, record.as_bytes()),
            Section::table(Tag::TEXT_STARTS, starts.as_bytes()),
            Section::table(Tag::TEXTS, &pool),
        ];
        assemble(&sections, 0, self.bank.fingerprint(), |_| ())
    }

    /// The clips with their texts in a locale.
    fn clips(&self, locale: Locale<'data>) -> Clips {
        let (mut clips, mut clip) = (Clips::default(), ClipData::default());
        let number = clips.locales.number(locale.tag(), false);
        for found in self.bank.clips() {
            clip.clear();
            clip.has_events = found.has_events(); // by which segments are numbered
            clip.starts.resize(found.segment_count() as usize, 0);
            if let Some(first) = found.segment(0).and_then(|segment| segment.text(locale)) {
                let texts = found.segments().map(|segment| segment.text_bytes(locale).unwrap_or_default());
                clip.add_texts(number, texts, first.is_fallback());
            }
            clips.push("", &clip);
        }
        clips
    }
}
