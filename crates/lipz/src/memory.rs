//! Return of freed memory to the system.

/// The size in bytes from which glibc maps allocations separately. This is its initial value.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
const LARGE_BYTES: libc::c_int = 128 << 10;

/// Makes freed memory return to the system.
///
/// After a large allocation is freed, glibc keeps all freed memory up to that size, for programs that allocate it again
/// soon. This program makes a bank from clips once and frees the clips meanwhile: with the memory that glibc keeps, it
/// takes a fifth more.
pub(crate) fn give_back() {
    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    #[allow(unsafe_code, reason = "no safe function sets how much memory glibc keeps")]
    // SAFETY: passes two numbers, before there are other threads. A glibc that rejects them behaves as before.
    unsafe {
        libc::mallopt(libc::M_MMAP_THRESHOLD, LARGE_BYTES);
    }
}
