//! Sets of banks: which of them has a clip.
//!
//! C keeps the banks of a set as it likes: all in an array, or those that it needs. These functions say which banks there are,
//! and which of them to ask about a clip; all else is asked of that bank.

#![allow(clippy::cast_possible_truncation)] // an index is shorter than 4 GiB, and has fewer banks and clips than bytes

use crate::bank::{Bank, opened};
use crate::pointer::{answer, bytes};
use crate::status::{LIPZ_NONE, LIPZ_NULL_POINTER, LIPZ_OK, Status, of_damage};
use crate::string::String;
use core::mem::MaybeUninit;
use core::ptr;
use lipz_bank::{ClipId, ErrorKind, SetIndex};

/// The index of a set: the caller's bytes. It owns nothing: copy it, keep it, forget it.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Set {
    /// The bytes of the index, at any address.
    pub data: *const u8,
    /// Length of the index.
    pub length_bytes: usize,
}

impl Default for Set {
    fn default() -> Set {
        Set { data: ptr::null(), length_bytes: 0 }
    }
}

/// What a set has.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct SetInfo {
    /// Hash of what the clips of all banks are.
    pub fingerprint: u64,
    /// Number of clips in all banks.
    pub clip_count: u64,
    /// Number of banks.
    pub bank_count: u32,
    /// Number of clips that are not in the bank of their id, but in that of their line: dubs.
    pub moved_count: u32,
}

/// What the index says about a bank.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct SetBank {
    /// The name of its file, which is beside the index.
    pub file_name: String,
    /// The checksum of the bank.
    pub checksum: u64,
    /// Its fingerprint.
    pub fingerprint: u64,
    /// Its length.
    pub length_bytes: u32,
    /// Number of its clips.
    pub clip_count: u32,
}

/// Opens the index of a set (`.lipzset`) and checks every byte of it: it is short. The banks that it names are opened and verified
/// on their own.
///
/// `damage_offset_bytes` may be null; otherwise it gets the place of what is wrong, and 0 if nothing is.
#[no_mangle]
pub unsafe extern "C" fn lipz_set_open(
    data: *const u8,
    length_bytes: usize,
    set: Option<&mut MaybeUninit<Set>>,
    damage_offset_bytes: Option<&mut MaybeUninit<u32>>,
) -> Status {
    let place = damage_offset_bytes.map(|offset| offset.write(0));
    answer(set, || {
        // SAFETY: the contract of the crate, which the caller keeps.
        let bytes = unsafe { bytes(data, length_bytes) }?;
        match SetIndex::open(bytes).and_then(SetIndex::verify) {
            Ok(_) => Ok(Set { data, length_bytes }),
            Err(error) => {
                if let Some(place) = place {
                    *place = error.offset_bytes();
                }
                Err(of_damage(error))
            }
        }
    })
}

/// What the set has.
#[no_mangle]
pub unsafe extern "C" fn lipz_set_info(set: Option<&Set>, info: Option<&mut MaybeUninit<SetInfo>>) -> Status {
    answer(info, || {
        // SAFETY: the contract of the crate, which the caller keeps.
        let index = unsafe { index(set) }?;
        Ok(SetInfo {
            fingerprint: index.fingerprint(),
            clip_count: index.clip_count(),
            bank_count: index.bank_count() as u32,
            moved_count: index.moved_count() as u32,
        })
    })
}

/// What the set says about the bank with this number, from 0. `LIPZ_NONE` behind the last.
#[no_mangle]
pub unsafe extern "C" fn lipz_set_bank_at(
    set: Option<&Set>,
    number: u32,
    bank: Option<&mut MaybeUninit<SetBank>>,
) -> Status {
    answer(bank, || {
        // SAFETY: the contract of the crate, which the caller keeps.
        let found = unsafe { index(set) }?.bank_at(number as usize).ok_or(LIPZ_NONE)?;
        Ok(SetBank {
            file_name: String::from_text(found.file_name),
            checksum: found.checksum,
            fingerprint: found.fingerprint,
            length_bytes: found.length_bytes,
            clip_count: found.clip_count,
        })
    })
}

/// The number of the bank that has the clip with this id, if any bank has it: ask that one. `lipz_clip_id_of_key` gives the id of a
/// key.
#[no_mangle]
pub unsafe extern "C" fn lipz_set_bank_of(set: Option<&Set>, id: u64, number: Option<&mut MaybeUninit<u32>>) -> Status {
    answer(number, || {
        // SAFETY: the contract of the crate, which the caller keeps.
        let index = unsafe { index(set) }?;
        Ok(index.bank_of(ClipId::from_u64(id)) as u32)
    })
}

/// Checks that an opened bank is the one with this number in the set; otherwise the status is bank error 44. Call it once for
/// each bank, after opening it.
#[no_mangle]
pub unsafe extern "C" fn lipz_set_check_bank(set: Option<&Set>, number: u32, bank: Option<&Bank>) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    match unsafe { is_bank(set, number, bank) } {
        Ok(true) => LIPZ_OK,
        Ok(false) => Status::from(ErrorKind::OtherBank.number()),
        Err(status) => status,
    }
}

/// # Safety
/// As for [`lipz_set_check_bank`].
unsafe fn is_bank(set: Option<&Set>, number: u32, bank: Option<&Bank>) -> Result<bool, Status> {
    // SAFETY: the same contract.
    let (index, bank) = unsafe { (index(set)?, opened(bank)?) };
    Ok(index.bank_at(number as usize).map_or(false, |named| named.is_of(&bank)))
}

/// The index of a set. Its numbers were checked by `lipz_set_open`, or lead nowhere.
///
/// # Safety
/// The bytes of the set are there.
unsafe fn index<'data>(set: Option<&Set>) -> Result<SetIndex<'data>, Status> {
    let set = set.ok_or(LIPZ_NULL_POINTER)?;
    // SAFETY: the same contract.
    SetIndex::open(unsafe { bytes(set.data, set.length_bytes) }?).map_err(of_damage)
}
