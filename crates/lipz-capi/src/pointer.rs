//! Converts every pointer of C to a Rust value, or rejects it.

use crate::status::{LIPZ_NOT_UTF8, LIPZ_NULL_POINTER, LIPZ_OK, Status};
use crate::string::c_char;
use core::mem::{MaybeUninit, size_of};
use core::slice;
use lipz_bank::curve::CurveValue;

/// Writes the answer of `find` to `out`, or an empty answer on failure.
pub(crate) fn answer<T: Default>(out: Option<&mut MaybeUninit<T>>, find: impl FnOnce() -> Result<T, Status>) -> Status {
    let out = match out {
        Some(out) => out,
        None => return LIPZ_NULL_POINTER,
    };
    let (value, status) = match find() {
        Ok(value) => (value, LIPZ_OK),
        Err(status) => (T::default(), status),
    };
    out.write(value);
    status
}

/// Returns the `length_bytes` bytes at `data`, for as long as the caller of the library keeps them.
///
/// # Safety
/// `data` is null or leads to that many bytes, which do not change.
pub(crate) unsafe fn bytes<'data>(data: *const u8, length_bytes: usize) -> Result<&'data [u8], Status> {
    if data.is_null() || length_bytes > isize::MAX.unsigned_abs() {
        return Err(LIPZ_NULL_POINTER);
    }
    // SAFETY: not null, and of a length that a slice can have; the rest is the contract.
    Ok(unsafe { slice::from_raw_parts(data, length_bytes) })
}

/// Writes zeros to `count` numbers, and returns them as values of curves.
///
/// # Safety
/// `data` is null or leads to room for that many numbers, which nothing else uses.
pub(crate) unsafe fn zeros<'out>(data: *mut i32, count: usize) -> Result<&'out mut [CurveValue], Status> {
    const MOST: usize = isize::MAX as usize / size_of::<i32>();
    if data.is_null() || count > MOST {
        return Err(LIPZ_NULL_POINTER);
    }
    // SAFETY: not null, and of a length that a slice can have; `CurveValue` is transparent; the rest is the contract.
    unsafe {
        data.write_bytes(0, count);
        Ok(slice::from_raw_parts_mut(data.cast(), count))
    }
}

/// Returns a string argument.
///
/// # Safety
/// As [`bytes`].
pub(crate) unsafe fn text<'data>(data: *const c_char, length_bytes: usize) -> Result<&'data str, Status> {
    // SAFETY: the same contract; `char` has one byte.
    let bytes = unsafe { bytes(data.cast(), length_bytes) }?;
    core::str::from_utf8(bytes).map_err(|_| LIPZ_NOT_UTF8)
}
