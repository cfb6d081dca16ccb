//! A bank together with its text banks.

use crate::layers;
use lipz_bank::{Bank, Locale, TextBank};
use lipz_diagnostics::Report;

/// A bank, and the text banks that hold its texts if it was [split](crate::SplitBank).
///
/// Functions about a whole dialogue take it; for a bank that was not split, a `&Bank` will do.
///
/// ```
/// use lipz_bank::Bank;
/// use lipz_compiler::{BankWithTexts, Compiler, Input, SplitBank, coverage};
/// let file = br#"{ "text_en-us": "Aye.", "text_de-de": "Ja." }"#;
/// let bank = Compiler::default().compile(&[Input::from_bytes("aye", file)]).bank.ok_or("no bank")?;
/// let split = SplitBank::from_bytes(&bank).map_err(|report| report.to_string())?;
/// let base = Bank::open(&split.base)?.verify()?;
/// let texts = [base.open_texts(&split.texts[0].1)?.verify(&base)?];
/// assert_eq!(coverage(&base).len(), 0);
/// assert_eq!(coverage(BankWithTexts::new(&base, &texts))[0].tag, "de-de");
/// assert_eq!(coverage(&Bank::open(&bank)?.verify()?).len(), 2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct BankWithTexts<'data, 'bank> {
    bank: &'bank Bank<'data>,
    texts: &'bank [TextBank<'data>],
}

impl<'data, 'bank> From<&'bank Bank<'data>> for BankWithTexts<'data, 'bank> {
    fn from(bank: &'bank Bank<'data>) -> Self {
        BankWithTexts { bank, texts: &[] }
    }
}

impl<'data, 'bank> BankWithTexts<'data, 'bank> {
    /// A bank with text banks that it opened.
    pub fn new(bank: &'bank Bank<'data>, texts: &'bank [TextBank<'data>]) -> Self {
        BankWithTexts { bank, texts }
    }

    /// The bank, which has the clips.
    pub fn bank(self) -> &'bank Bank<'data> {
        self.bank
    }

    /// The text banks.
    pub fn texts(self) -> &'bank [TextBank<'data>] {
        self.texts
    }

    /// All locales, in the order of their tags. Of several with one tag, the bank's goes before that of a text
    /// bank, and a text bank's before those of later ones.
    pub fn locales(self) -> Vec<Locale<'data>> {
        let mut locales: Vec<_> = self.bank.locales().chain(self.texts.iter().flat_map(TextBank::locales)).collect();
        locales.sort_by_key(Locale::tag);
        locales.dedup_by_key(|locale| locale.tag());
        locales
    }

    /// One bank with all of these texts, which answers as the one that was split: text banks do not say which locale a fallback
    /// is of, so it has these texts again.
    ///
    /// # Errors
    /// If the bank is a layer over others, or too large as a whole.
    pub fn joined(self) -> Result<Vec<u8>, Report> {
        layers::joined(self.bank, self.texts)
    }
}
