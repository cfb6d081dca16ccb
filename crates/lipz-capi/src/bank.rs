//! Opening banks, and the way of every query into one.

use crate::pointer::{answer, bytes};
use crate::status::{LIPZ_NOT_OPENED, LIPZ_NULL_POINTER, LIPZ_OK, Status, of_damage};
use core::mem::MaybeUninit;
use core::ptr;
use lipz_bank::{Error, Locales, Places, TextBank};

/// How many words the places of the sections take.
pub const LIPZ_PLACE_WORDS: usize = 34;

/// An opened bank: the caller's bytes, and beside them those of a text bank, if one is used. It owns
/// nothing: copy it, keep it, forget it.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Bank {
    /// The bytes of the bank, at any address: a mapped file, ROM, memory.
    pub data: *const u8,
    /// Length of the bank.
    pub length_bytes: usize,
    /// The bytes of the text bank that has the locales; null if they are those of the bank itself.
    pub texts: *const u8,
    /// Length of the text bank.
    pub texts_length_bytes: usize,
    /// Where `lipz_bank_open` has found the sections, and the checksum of the bank. Each query looks whether the bytes
    /// still have this checksum, and whether the places lie in them.
    pub places: [u32; LIPZ_PLACE_WORDS],
}

impl Default for Bank {
    fn default() -> Bank {
        Bank {
            data: ptr::null(),
            length_bytes: 0,
            texts: ptr::null(),
            texts_length_bytes: 0,
            places: [0; LIPZ_PLACE_WORDS],
        }
    }
}

/// What a bank has.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct BankInfo {
    /// Hash of what the clips are: a bank and its text banks share it.
    pub fingerprint: u64,
    /// Number of clips: their slots are the numbers below it.
    pub clip_count: u32,
    /// Number of locales: those of the text bank, if one is used.
    pub locale_count: u32,
    /// Major format version.
    pub format_major: u32,
    /// Minor format version.
    pub format_minor: u32,
}

/// Opens the bank that fills `length_bytes` bytes at `data`: checks header and directory, in a time
/// that does not depend on the number of clips. Keep `bank`, and open it again when other bytes are at `data`.
///
/// `damage_offset_bytes` may be null; otherwise it gets the place of what is wrong, and 0 if nothing is.
#[no_mangle]
pub unsafe extern "C" fn lipz_bank_open(
    data: *const u8,
    length_bytes: usize,
    bank: Option<&mut MaybeUninit<Bank>>,
    damage_offset_bytes: Option<&mut MaybeUninit<u32>>,
) -> Status {
    let place = damage_offset_bytes.map(|offset| offset.write(0));
    let bank = match bank {
        Some(bank) => bank.write(Bank::default()),
        None => return LIPZ_NULL_POINTER,
    };
    // SAFETY: the contract of the crate, which the caller keeps.
    let found = unsafe { bytes(data, length_bytes) }.and_then(|bytes| told(Places::find(bytes), place));
    match found {
        Ok(places) => {
            // Written where it stays: a bank is many words to be copied.
            bank.data = data;
            bank.length_bytes = length_bytes;
            bank.places = places.to_words();
            LIPZ_OK
        }
        Err(status) => status,
    }
}

/// Makes `bank` use the locales of a text bank: opens it, and checks that it belongs to the clips.
/// Unless that succeeds, `bank` stays as it was.
///
/// `damage_offset_bytes` as for `lipz_bank_open`; the place is one in the text bank.
#[no_mangle]
pub unsafe extern "C" fn lipz_bank_use_texts(
    bank: Option<&mut Bank>,
    texts: *const u8,
    texts_length_bytes: usize,
    damage_offset_bytes: Option<&mut MaybeUninit<u32>>,
) -> Status {
    let place = damage_offset_bytes.map(|offset| offset.write(0));
    let bank = match bank {
        Some(bank) => bank,
        None => return LIPZ_NULL_POINTER,
    };
    let with_texts = Bank { texts, texts_length_bytes, ..*bank };
    // SAFETY: the contract of the crate, which the caller keeps.
    let opened = unsafe { opened(Some(bank)).and_then(|opened| Ok((opened, bytes(texts, texts_length_bytes)?))) };
    let result = opened.and_then(|(opened, texts)| told(opened.open_texts(texts), place));
    match result {
        Ok(_) => {
            *bank = with_texts;
            LIPZ_OK
        }
        Err(status) => status,
    }
}

/// Checks every byte and reference of a bank, and of its text bank. After it no query fails for
/// which the bank has data.
///
/// `damage_offset_bytes` as for `lipz_bank_open`; the place is one in the text bank if the bank is
/// whole.
#[no_mangle]
pub unsafe extern "C" fn lipz_bank_verify(
    bank: Option<&Bank>,
    damage_offset_bytes: Option<&mut MaybeUninit<u32>>,
) -> Status {
    let place = damage_offset_bytes.map(|offset| offset.write(0));
    // SAFETY: the contract of the crate, which the caller keeps.
    let verified = unsafe { opened_with_texts(bank) }.and_then(|Opened { bank, texts }| {
        let verified = bank.verify().and_then(|bank| texts.map_or(Ok(()), |texts| texts.verify(&bank).map(|_| ())));
        told(verified, place)
    });
    verified.err().unwrap_or(LIPZ_OK)
}

/// What a bank has.
#[no_mangle]
pub unsafe extern "C" fn lipz_bank_info(bank: Option<&Bank>, info: Option<&mut MaybeUninit<BankInfo>>) -> Status {
    answer(info, || {
        // SAFETY: the contract of the crate, which the caller keeps.
        let opened = unsafe { opened_with_texts(bank) }?;
        let (major, minor) = opened.bank.format_version();
        Ok(BankInfo {
            fingerprint: opened.bank.fingerprint(),
            clip_count: number(opened.bank.clip_count()),
            locale_count: number(opened.locales().count()),
            format_major: major.into(),
            format_minor: minor.into(),
        })
    })
}

/// The bank of the caller's bytes. Nothing in `bank` is believed: not that it has these sections, nor that they lie in
/// the bytes.
///
/// # Safety
/// The contract of the crate.
pub(crate) unsafe fn opened<'data>(bank: Option<&Bank>) -> Result<lipz_bank::Bank<'data>, Status> {
    let bank = bank.ok_or(LIPZ_NULL_POINTER)?;
    // SAFETY: the same contract.
    let bytes = unsafe { bytes(bank.data, bank.length_bytes) }?;
    lipz_bank::Bank::open_at(bytes, &Places::from_words(bank.places)).ok_or(LIPZ_NOT_OPENED)
}

/// A bank, and the text bank beside it, if one is used.
pub(crate) struct Opened<'data> {
    pub(crate) bank: lipz_bank::Bank<'data>,
    texts: Option<TextBank<'data>>,
}

impl<'data> Opened<'data> {
    /// The locales of the text bank if one is used, otherwise those of the bank.
    pub(crate) fn locales(&self) -> Locales<'data> {
        self.texts.as_ref().map_or_else(|| self.bank.locales(), TextBank::locales)
    }

    /// What tells the files that the locales are from apart from others.
    pub(crate) fn origin(&self) -> u32 {
        let texts = self.texts.as_ref().map_or(0, |texts| (texts.checksum() & 0xFFFF_FFFF) as u32);
        // Turned, so that one file in both places is not no file.
        origin(&self.bank) ^ texts.rotate_left(1)
    }
}

/// What tells a bank apart from others: half of its checksum, each bit of which depends on all of the contents.
pub(crate) fn origin(bank: &lipz_bank::Bank<'_>) -> u32 {
    (bank.checksum() & 0xFFFF_FFFF) as u32
}

/// The bank of the caller's bytes, and the text bank beside it.
///
/// # Safety
/// The contract of the crate.
pub(crate) unsafe fn opened_with_texts<'data>(bank: Option<&Bank>) -> Result<Opened<'data>, Status> {
    // SAFETY: the same contract.
    let opened = unsafe { opened(bank) }?;
    let texts = match bank {
        Some(bank) if !bank.texts.is_null() => {
            // SAFETY: the same contract.
            let bytes = unsafe { bytes(bank.texts, bank.texts_length_bytes) }?;
            Some(opened.open_texts(bytes).map_err(of_damage)?)
        }
        _ => None,
    };
    Ok(Opened { bank: opened, texts })
}

/// A number of things that stand in a file, whose length has 32 bits.
fn number(count: usize) -> u32 {
    u32::try_from(count).unwrap_or(u32::MAX)
}

/// The status of damage; writes down where it is.
fn told<T>(result: Result<T, Error>, place: Option<&mut u32>) -> Result<T, Status> {
    if let (Err(error), Some(place)) = (&result, place) {
        *place = error.offset_bytes();
    }
    result.map_err(of_damage)
}
