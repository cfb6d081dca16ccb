//! Files that pretend to be banks or text banks.

use crate::exercise::{Effort, every_text_query, provoke};
use crate::golden::{SMALL, reseal, verified};
use lipz_bank::Bank;
use lipz_layout::Header;
use std::mem::offset_of;

/// Opens any bytes, asks everything, verifies, and asks again. Then once more with the length and the
/// checksum that a forger would write.
pub fn bank(bytes: &[u8]) {
    provoke(bytes, Effort::Few);
    provoke(&sealed(bytes), Effort::Few);
}

/// The same for text banks beside a bank, verified or not.
pub fn text_bank(bytes: &[u8]) {
    let banks = [Bank::open(SMALL).expect("a golden bank"), verified(SMALL)];
    for bytes in [bytes, &sealed(bytes)] {
        for bank in &banks {
            let Ok(texts) = bank.open_texts(bytes) else { continue };
            every_text_query(bank, &texts);
            if let Ok(texts) = texts.verify(bank) {
                assert!(bank.is_verified() && every_text_query(bank, &texts), "a verified text bank lacks texts");
            }
        }
    }
}

/// The bytes with the right length and checksum, where they have room for a header.
fn sealed(bytes: &[u8]) -> Vec<u8> {
    let mut sealed = bytes.to_vec();
    if sealed.len() >= size_of::<Header>() {
        let at = offset_of!(Header, file_length_bytes);
        crate::golden::put(&mut sealed, at, (bytes.len() as u32).to_le_bytes());
        reseal(&mut sealed);
    }
    sealed
}
