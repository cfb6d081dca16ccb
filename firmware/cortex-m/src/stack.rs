//! How deep the stack gets: it is painted, and afterwards the paint that is left is counted.

use core::arch::asm;
use core::ptr;

/// What unused words of the stack hold.
const PAINT: u32 = 0xACAC_ACAC;

extern "C" {
    static mut stack_start: u32;
}

/// Bytes of the stack that `step` uses.
#[inline(never)]
pub(crate) fn depth_bytes(step: impl FnOnce()) -> usize {
    let bottom = ptr::addr_of_mut!(stack_start);
    let top: *mut u32;
    // SAFETY: reads a register.
    unsafe { asm!("mov {}, sp", out(reg) top, options(nomem, nostack)) };
    let mut place = bottom;
    while place < top {
        // SAFETY: the memory from `stack_start` to the stack pointer belongs to the stack, and
        // nothing that is in use lies there: this function calls nobody while it paints.
        unsafe { place.write_volatile(PAINT) };
        place = place.wrapping_add(1);
    }
    step();
    let mut place = bottom;
    // SAFETY: as above; read only.
    while place < top && unsafe { place.read_volatile() } == PAINT {
        place = place.wrapping_add(1);
    }
    top as usize - place as usize
}
