//! A bank in the memory of a wasm machine: opened, verified and asked everything.

#![no_std]

use core::panic::PanicInfo;
use core::slice::from_raw_parts;
use firmware_check::{answers_as, verified};

/// What `check` returns if the bank or the answers cannot be read at all.
const REFUSED: u32 = u32::MAX;

/// Compares the answers of a bank with expected ones: 0, or the number of the first that differs,
/// or `REFUSED`.
///
/// # Safety
/// The bank and the answers lie in memory as stated, and nothing writes to them meanwhile.
#[no_mangle]
pub unsafe extern "C" fn check(bank: *const u8, bank_bytes: usize, answers: *const u8, answers_bytes: usize) -> u32 {
    // SAFETY: the caller promises it.
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
