//! The hash of clip ids, the clip index and fingerprints (`docs/reference/bank-format.md`, "Clip ids").

/// Odd 64-bit multiplier without structure: the fractional part of the golden ratio.
pub const STEP: u64 = 0x9E37_79B9_7F4A_7C15;

/// Multiplier of the finish (Pelle Evensen's `rrmxmx` study; any odd constant with good avalanche).
pub const FINISH: u64 = 0x9FB2_1C65_1E98_DF25;

/// Multiplies, and folds the well-mixed high half into the low one.
#[inline]
pub const fn mix(value: u64, multiplier: u64) -> u64 {
    let product = value.wrapping_mul(multiplier);
    product ^ (product >> 32)
}
