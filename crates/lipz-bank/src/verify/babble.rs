//! Babble profiles, one behind the other in the order of their names.

use super::error_in;
use crate::babble::Babble;
use crate::{Bank, Error, ErrorKind};

/// Checks the section, if the bank has it.
pub(super) fn babble(bank: &Bank<'_>) -> Result<(), Error> {
    let mut rest = bank.file.section(lipz_layout::Tag::BABBLE);
    let mut before: &[u8] = &[];
    while !rest.is_empty() {
        match Babble::split_first(rest) {
            Some((babble, behind)) if babble.name_bytes() > before && is_valid(&babble) => {
                before = babble.name_bytes();
                rest = behind;
            }
            _ => return Err(error_in(&bank.file, ErrorKind::Babble, rest)),
        }
    }
    Ok(())
}

fn is_valid(babble: &Babble<'_>) -> bool {
    let strings = [babble.ooh(), babble.aah(), babble.ooh_power_transfer(), babble.aah_power_transfer()];
    let are_digits = strings.iter().all(|digits| !digits.is_empty() && digits.iter().all(u8::is_ascii_digit));
    are_digits && core::str::from_utf8(babble.name_bytes()).is_ok()
}
