//! Opens and verifies a bank in the memory of a wasm machine, and makes every query.

#![no_std]

use core::panic::PanicInfo;
use core::slice::from_raw_parts;
use firmware_check::{answers_as, verified};

/// The result of `check` if the bank or the answers cannot be read.
const REFUSED: u32 = u32::MAX;

/// Compares the answers of a bank with expected ones. Returns 0, the number of the first difference, or `REFUSED`.
///
/// # Safety
/// The bank and the answers are in memory as stated, and do not change during the call.
#[no_mangle]
pub unsafe extern "C" fn check(bank: *const u8, bank_bytes: usize, answers: *const u8, answers_bytes: usize) -> u32 {
    // SAFETY: by the contract of the caller.
    let (bank, answers) = unsafe { (from_raw_parts(bank, bank_bytes), from_raw_parts(answers, answers_bytes)) };
    match (verified(bank), core::str::from_utf8(answers)) {
        (Ok(bank), Ok(answers)) => answers_as(&bank, answers).map_or_else(|failure| failure.line(), |()| 0),
        _ => REFUSED,
    }
}

#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    core::arch::wasm32::unreachable()
}
