//! The panic handler of the libraries: a proof, while linking, that it is never called.

use core::panic::PanicInfo;

extern "C" {
    /// Defined nowhere: a library from which a panic can be reached does not link.
    fn lipz_a_panic_can_be_reached() -> !;
}

#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    // SAFETY: it is never linked.
    unsafe { lipz_a_panic_can_be_reached() }
}
