//! Clip ids: the 64-bit hash of a clip's key, computable while compiling.

use core::fmt;

/// 64-bit hash of a clip's key.
///
/// The compiler proves that no two clips of a bank share an id, so within a bank an id is as good
/// as the key, and eight bytes instead of a string.
///
/// ```
/// use lipz_bank::ClipId;
/// const HELLO: ClipId = ClipId::of("act1/samson-hello");
/// assert_eq!(HELLO.get(), 0xffff_95a9_0441_eeda);
/// ```
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ClipId(u64);

/// Odd 64-bit multiplier with no structure: the fractional part of the golden ratio.
pub(crate) const STEP: u64 = 0x9E37_79B9_7F4A_7C15;
/// Multiplier of the finish (Pelle Evensen's `rrmxmx` study; any odd constant with good avalanche).
pub(crate) const FINISH: u64 = 0x9FB2_1C65_1E98_DF25;

impl ClipId {
    /// The id of `key`, the path of a Lipz file below its source root, with `/` and without
    /// extension.
    ///
    /// The function is FNV-1a widened to eight bytes a step, with the high half folded down after
    /// each multiplication; `docs/FORMAT.md`, "Clip ids", gives it in words and with test vectors.
    pub const fn of(key: &str) -> ClipId {
        let mut rest = key.as_bytes();
        let mut hash = mix(rest.len() as u64, STEP);
        while let [a, b, c, d, e, f, g, h, tail @ ..] = rest {
            let word = u64::from_le_bytes([*a, *b, *c, *d, *e, *f, *g, *h]);
            hash = mix(hash ^ word, STEP);
            rest = tail;
        }
        let mut word = 0;
        while let [head @ .., last] = rest {
            word = word << 8 | *last as u64;
            rest = head;
        }
        ClipId(mix(mix(hash ^ word, STEP), FINISH))
    }

    /// The id with the given value, as stored in generated headers and in the bank.
    pub const fn from_u64(value: u64) -> ClipId {
        ClipId(value)
    }

    /// The value of the id.
    pub const fn get(self) -> u64 {
        self.0
    }
}

/// Multiplies and folds the well-mixed high half into the low one.
pub(crate) const fn mix(value: u64, multiplier: u64) -> u64 {
    let product = value.wrapping_mul(multiplier);
    product ^ (product >> 32)
}

impl fmt::Debug for ClipId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "ClipId({:#018x})", self.0)
    }
}

impl fmt::Display for ClipId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:016x}", self.0)
    }
}
