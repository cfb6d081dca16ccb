//! The machine's vectors and memory, and semihosting, with which the firmware prints and exits in an emulator.

use core::arch::asm;
use core::fmt::{self, Arguments, Write};
use core::slice::from_raw_parts;

/// Semihosting operations and reasons to end (Arm, "Semihosting for AArch32 and AArch64").
const SYS_WRITEC: usize = 0x03;
const SYS_EXIT: usize = 0x18;
const APPLICATION_EXIT: usize = 0x2_0026;
const RUN_TIME_ERROR: usize = 0x2_0023;

/// The offset of a bank's length in its header.
const FILE_LENGTH_OFFSET: usize = 16;

extern "C" {
    // Addresses from the linker script.
    static bank_start: u8;
    static answers_start: u8;
    static answers_end: u8;
}

/// The vectors after the start of the stack: reset, and the exceptions that can end a program.
#[used]
#[link_section = ".vectors"]
static VECTORS: [extern "C" fn() -> !; 6] = [crate::reset, fault, fault, fault, fault, fault];

extern "C" fn fault() -> ! {
    say(format_args!("the processor raised a fault\n"));
    exit(false)
}

/// Returns the memory between two addresses of the linker script.
fn memory(start: &'static u8, end: &'static u8) -> &'static [u8] {
    let length_bytes = end as *const u8 as usize - start as *const u8 as usize;
    // SAFETY: the linker script sets the two symbols to the bounds of memory that the emulator filled before the
    // processor started, and that is never written.
    unsafe { from_raw_parts(start, length_bytes) }
}

/// Returns the bank in memory, with the length in its header.
pub(crate) fn bank() -> &'static [u8] {
    // SAFETY: both are addresses of the linker script, and only the addresses are used.
    let memory = unsafe { memory(&bank_start, &answers_start) };
    let length = memory.get(FILE_LENGTH_OFFSET..).and_then(|behind| behind.first_chunk::<4>());
    let length_bytes = length.map_or(0, |bytes| u32::from_le_bytes(*bytes) as usize);
    memory.get(..length_bytes).unwrap_or(memory)
}

/// Returns the expected answers in memory, which are followed by zeros.
pub(crate) fn expected_answers() -> &'static str {
    // SAFETY: as above.
    let memory = unsafe { memory(&answers_start, &answers_end) };
    let length_bytes = memory.iter().position(|byte| *byte == 0).unwrap_or(memory.len());
    core::str::from_utf8(&memory[..length_bytes]).unwrap_or("(not UTF-8)")
}

/// Makes a request to the emulator.
fn call(operation: usize, argument: usize) {
    // SAFETY: operation and argument are as defined by semihosting, which at most reads memory.
    unsafe { asm!("bkpt #0xAB", inout("r0") operation => _, in("r1") argument, options(nostack, readonly)) };
}

/// Prints a message.
pub(crate) fn say(message: Arguments<'_>) {
    let _ = Console.write_fmt(message);
}

/// Ends the emulator, with exit code 0 or 1.
pub(crate) fn exit(is_success: bool) -> ! {
    call(SYS_EXIT, if is_success { APPLICATION_EXIT } else { RUN_TIME_ERROR });
    loop {}
}

struct Console;

impl Write for Console {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        text.bytes().for_each(|byte| call(SYS_WRITEC, &byte as *const u8 as usize));
        Ok(())
    }
}
