//! Arbitrary files as banks or text banks.

use crate::exercise::{Effort, every_text_query, provoke};
use crate::golden::{SMALL, reseal, verified};
use crate::stacked::{every_query, every_query_verified};
use crate::texts::{with_texts, with_texts_unverified};
use lipz_bank::Bank;
use lipz_bank::files::{DialogueFile, FileKind};
use lipz_layout::Header;
use std::mem::offset_of;

/// Opens any bytes, makes every query, verifies, and queries again. Then does the same with the length and the checksum
/// that a forger would write.
pub fn bank(bytes: &[u8]) {
    provoke(bytes, Effort::Few);
    provoke(&sealed(bytes), Effort::Few);
}

/// The same for text banks with a bank, verified or not.
pub fn text_bank(bytes: &[u8]) {
    let verified_bank = verified(SMALL);
    let banks = [Bank::open(SMALL).expect("a golden bank"), verified_bank];
    for bytes in [bytes, &sealed(bytes)] {
        for bank in &banks {
            let Ok(opened) = with_texts_unverified(bank, bytes) else { continue };
            every_text_query(&opened);
            let verified = with_texts(bank, bytes);
            if let Ok(opened) = verified {
                assert!(bank.is_verified() && every_text_query(&opened), "a verified text bank lacks texts");
            }
            // The same must apply in a dialogue.
            every_query(&[SMALL, bytes]);
            let is_texts = DialogueFile::open(bytes, 1).is_ok_and(|file| file.kind() == FileKind::Texts);
            let is_right = with_texts(&verified_bank, bytes).is_ok();
            assert_eq!(every_query_verified(&[SMALL, bytes]), is_texts && is_right);
        }
    }
}

/// Returns the bytes with the correct length and checksum, if they have room for a header.
fn sealed(bytes: &[u8]) -> Vec<u8> {
    let mut sealed = bytes.to_vec();
    if sealed.len() >= size_of::<Header>() {
        let at = offset_of!(Header, file_length_bytes);
        crate::golden::put(&mut sealed, at, (bytes.len() as u32).to_le_bytes());
        reseal(&mut sealed);
    }
    sealed
}
