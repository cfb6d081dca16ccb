//! The version of the library, to detect a mismatch between header and shared library.

/// Version of this header. A change of the first number breaks programs. While it is 0, so does a change of the second.
pub const LIPZ_VERSION_MAJOR: u32 = 0;
/// Second number of the version.
pub const LIPZ_VERSION_MINOR: u32 = 1;
/// Third number of the version.
pub const LIPZ_VERSION_PATCH: u32 = 0;

/// Returns the version of the running library, as `major * 1000000 + minor * 1000 + patch`.
#[no_mangle]
pub extern "C" fn lipz_version() -> u32 {
    const VERSION: u32 = LIPZ_VERSION_MAJOR * 1_000_000 + LIPZ_VERSION_MINOR * 1000 + LIPZ_VERSION_PATCH;
    VERSION
}

#[cfg(test)]
mod tests {
    use super::*;
    extern crate std;

    #[test]
    fn the_version_is_that_of_the_crate() {
        let version = std::format!("{LIPZ_VERSION_MAJOR}.{LIPZ_VERSION_MINOR}.{LIPZ_VERSION_PATCH}");
        assert_eq!(version, env!("CARGO_PKG_VERSION"));
    }
}
