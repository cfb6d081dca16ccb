//! Checks phones and articulation profiles.

use super::phones::PhoneTable;
use super::profile::ArticulationProfile;
use super::rig::Rig;
use crate::verify::{error_at, error_in};
use crate::{Bank, Error, ErrorKind};
use lipz_layout::Tag;

/// Checks the sections, if the bank has them.
pub(crate) fn check(bank: &Bank<'_>) -> Result<(), Error> {
    profiles(bank)?;
    let table = PhoneTable::new(bank);
    let (mut slots_end, mut end) = (0, 0);
    for (place, record) in table.clips.iter().enumerate() {
        let failed = error_at(bank, ErrorKind::Phones, record);
        let slot = record.slot.get();
        let follows = slot >= slots_end && (slot as usize) < bank.clips.len() && table.offset(place) == end;
        slots_end = slot.wrapping_add(1);
        end = table.offset(place.wrapping_add(1));
        let phones = table.phones(place);
        if !follows || end > table.bytes.len() || !phones.are_in_order() {
            return Err(failed);
        }
    }
    if end != table.bytes.len() {
        return Err(error_in(&bank.file, ErrorKind::Phones, table.bytes));
    }
    Ok(())
}

/// Checks articulation profiles and rigs, which follow each other, ordered by name.
fn profiles(bank: &Bank<'_>) -> Result<(), Error> {
    let mut rest = bank.file.section(Tag::RIGS);
    let mut before: &[u8] = &[];
    while !rest.is_empty() {
        match Rig::split_first(rest) {
            Some((rig, behind)) if rig.name_bytes() > before && rig.is_valid() && is_utf8(rig.name_bytes()) => {
                before = rig.name_bytes();
                rest = behind;
            }
            _ => return Err(error_in(&bank.file, ErrorKind::Rig, rest)),
        }
    }
    let mut rest = bank.file.section(Tag::ARTICULATION);
    let mut before: &[u8] = &[];
    while !rest.is_empty() {
        match ArticulationProfile::split_first(rest) {
            Some((profile, behind))
                if profile.name_bytes() > before && profile.is_valid() && is_utf8(profile.name_bytes()) =>
            {
                before = profile.name_bytes();
                rest = behind;
            }
            _ => return Err(error_in(&bank.file, ErrorKind::Phones, rest)),
        }
    }
    Ok(())
}

fn is_utf8(name: &[u8]) -> bool {
    core::str::from_utf8(name).is_ok()
}
