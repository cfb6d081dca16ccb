//! Banks with the locales of text banks.

use lipz_bank::{Bank, Error};

/// Returns a copy of the bank with the locales of a text bank, verified.
///
/// # Errors
/// As [`Bank::open_texts`].
pub fn with_texts<'a>(bank: &Bank<'a>, texts: &'a [u8]) -> Result<Bank<'a>, Error> {
    let mut bank = *bank;
    bank.open_texts(texts)?;
    Ok(bank)
}

/// The same, unverified.
///
/// # Errors
/// As [`Bank::open_texts_unverified`].
pub fn with_texts_unverified<'a>(bank: &Bank<'a>, texts: &'a [u8]) -> Result<Bank<'a>, Error> {
    let mut bank = *bank;
    bank.open_texts_unverified(texts)?;
    Ok(bank)
}
