//! Strings inside a bank.

use core::ptr;

/// `char` of C, behind a pointer. `core::ffi` has it since Rust 1.64.
#[allow(non_camel_case_types)]
pub type c_char = i8;

/// A string in UTF-8, without terminator. It is part of the bytes of the bank and lives as long as they do. It may
/// contain U+0000.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct String {
    /// The first byte; null only if there is no string.
    pub data: *const c_char,
    /// Length in bytes.
    pub length_bytes: usize,
}

impl String {
    pub(crate) fn from_text(text: &str) -> String {
        String::from_bytes(text.as_bytes())
    }

    pub(crate) fn from_bytes(bytes: &[u8]) -> String {
        String { data: bytes.as_ptr().cast(), length_bytes: bytes.len() }
    }
}

impl Default for String {
    fn default() -> String {
        String { data: ptr::null(), length_bytes: 0 }
    }
}
