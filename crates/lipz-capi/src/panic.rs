//! The panic handler of the libraries: a proof, while linking, that it is never called.

use core::panic::PanicInfo;

unsafe extern "C" {
    /// Defined nowhere: a library from which a panic can be reached does not link.
    safe fn lipz_a_panic_can_be_reached() -> !;
}

#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    lipz_a_panic_can_be_reached()
}
