//! The panic handler of the libraries: proves at link time that it is never called.

use core::panic::PanicInfo;

extern "C" {
    /// Not defined anywhere, so that a library with a reachable panic does not link.
    fn lipz_a_panic_can_be_reached() -> !;
}

#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    // SAFETY: it is never linked.
    unsafe { lipz_a_panic_can_be_reached() }
}
