//! Checks face profiles, which follow each other, ordered by name.

use crate::face::FaceProfile;
use crate::verify::error_in;
use crate::{Bank, Error, ErrorKind};

/// Checks the section, if the bank has it.
pub(crate) fn check(bank: &Bank<'_>) -> Result<(), Error> {
    let mut rest = bank.file.section(lipz_layout::Tag::FACES);
    let mut before: &[u8] = &[];
    while !rest.is_empty() {
        match FaceProfile::split_first(rest) {
            Some((profile, behind)) if profile.name_bytes() > before && is_valid(&profile) => {
                before = profile.name_bytes();
                rest = behind;
            }
            _ => return Err(error_in(&bank.file, ErrorKind::Face, rest)),
        }
    }
    Ok(())
}

fn is_valid(profile: &FaceProfile<'_>) -> bool {
    profile.is_valid() && core::str::from_utf8(profile.name_bytes()).is_ok()
}
