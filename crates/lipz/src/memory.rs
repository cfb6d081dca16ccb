//! How the program gives memory back to the system.

/// Bytes from which on a piece of memory is the system's own. glibc starts with this number.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
const LARGE_BYTES: libc::c_int = 128 << 10;

/// Makes memory that is given back leave the process.
///
/// Once a large piece was given back, glibc keeps all pieces up to that size, for programs that soon ask for them again.
/// This one makes a bank of clips, once, and gives the clips back while it does: with what glibc keeps of them, it takes
/// a fifth more.
pub(crate) fn give_back() {
    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    #[allow(unsafe_code, reason = "no safe function sets what glibc keeps")]
    // SAFETY: two numbers, before there is another thread. A glibc that does not take them goes on as before.
    unsafe {
        libc::mallopt(libc::M_MMAP_THRESHOLD, LARGE_BYTES);
    }
}
