//! Entry points that must not link, which show that a panic and an allocation would be detected.

extern crate alloc;

use alloc::boxed::Box;
use core::alloc::{GlobalAlloc, Layout};

extern "C" {
    /// Not defined anywhere, so that code that reaches it does not link.
    fn allocator_is_reachable() -> *mut u8;
}

struct Unreachable;

#[global_allocator]
static ALLOCATOR: Unreachable = Unreachable;

// SAFETY: it is never linked.
unsafe impl GlobalAlloc for Unreachable {
    unsafe fn alloc(&self, _: Layout) -> *mut u8 {
        // SAFETY: as above.
        unsafe { allocator_is_reachable() }
    }

    unsafe fn dealloc(&self, _: *mut u8, _: Layout) {}
}

#[no_mangle]
fn control_panic(bytes: &[u8], index: usize) -> u8 {
    bytes[index]
}

#[no_mangle]
fn control_allocator(value: u64) -> Box<u64> {
    Box::new(value)
}
