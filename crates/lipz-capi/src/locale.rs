//! Locales: which language texts are asked for in.

use crate::bank::{Bank, Opened, opened_with_texts};
use crate::pointer::{answer, text};
use crate::status::{LIPZ_NONE, Status};
use crate::string::String;
use crate::string::c_char;
use core::mem::MaybeUninit;

/// A locale of a bank. Look it up once; queries go by `index` and `bank`. With another bank, another text bank or
/// another version of one, it leads to `LIPZ_NONE`: look it up again.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct Locale {
    /// Its tag, as in `text_en-us` of a Lipz file: `en-us`.
    pub tag: String,
    /// Its place among the locales, which are in the order of their tags.
    pub index: u32,
    /// 1 for the default locale that was set when the bank was packed.
    pub is_default: u32,
    /// Tells the bank and the text bank that the locale is of apart from others.
    pub bank: u32,
}

impl Locale {
    /// The locale of the bank that has this index, if it is of this bank.
    pub(crate) fn find<'data>(&self, opened: &Opened<'data>) -> Option<lipz_bank::Locale<'data>> {
        if self.bank != opened.origin() {
            return None;
        }
        opened.locales().nth(self.index as usize)
    }
}

/// The locale with this tag, spelled as in the bank.
#[no_mangle]
pub unsafe extern "C" fn lipz_locale_by_tag(
    bank: Option<&Bank>,
    tag: *const c_char,
    tag_length_bytes: usize,
    locale: Option<&mut MaybeUninit<Locale>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe {
        of_locales(bank, locale, || {
            let tag = text(tag, tag_length_bytes)?;
            Ok(move |_, locale: &lipz_bank::Locale<'_>| locale.tag() == tag)
        })
    }
}

/// The locale with this index, a number below `locale_count` of the bank.
#[no_mangle]
pub unsafe extern "C" fn lipz_locale_at(
    bank: Option<&Bank>,
    index: u32,
    locale: Option<&mut MaybeUninit<Locale>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { of_locales(bank, locale, || Ok(move |at, _: &lipz_bank::Locale<'_>| at == index)) }
}

/// The default locale; `LIPZ_NONE` if none was set when the bank was packed.
#[no_mangle]
pub unsafe extern "C" fn lipz_locale_default(bank: Option<&Bank>, locale: Option<&mut MaybeUninit<Locale>>) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { of_locales(bank, locale, || Ok(|_, locale: &lipz_bank::Locale<'_>| locale.is_default())) }
}

/// Answers with the first locale that the test which `wanted` gives is true for.
///
/// # Safety
/// The contract of the crate.
unsafe fn of_locales<Test: FnMut(u32, &lipz_bank::Locale<'_>) -> bool>(
    bank: Option<&Bank>,
    out: Option<&mut MaybeUninit<Locale>>,
    wanted: impl FnOnce() -> Result<Test, Status>,
) -> Status {
    answer(out, || {
        // SAFETY: the same contract.
        let opened = unsafe { opened_with_texts(bank) }?;
        let mut is_wanted = wanted()?;
        let mut numbered = (0..).zip(opened.locales());
        let (index, locale) = numbered.find(|(index, locale)| is_wanted(*index, locale)).ok_or(LIPZ_NONE)?;
        let is_default = locale.is_default().into();
        Ok(Locale { tag: String::from_text(locale.tag()), index, is_default, bank: opened.origin() })
    })
}
