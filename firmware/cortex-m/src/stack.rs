//! Measures the depth of the stack: paints it, and then counts the remaining paint.

use core::arch::asm;
use core::ptr;

/// The value of unused words of the stack.
const PAINT: u32 = 0xACAC_ACAC;

extern "C" {
    static mut stack_start: u32;
}

/// Returns the bytes of the stack that `step` uses.
#[inline(never)]
pub(crate) fn depth_bytes(step: impl FnOnce()) -> usize {
    let bottom = ptr::addr_of_mut!(stack_start);
    let top: *mut u32;
    // SAFETY: reads a register.
    unsafe { asm!("mov {}, sp", out(reg) top, options(nomem, nostack)) };
    let mut place = bottom;
    while place < top {
        // SAFETY: the memory from `stack_start` to the stack pointer belongs to the stack, and is not in use, because
        // this function calls no other while it paints.
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
