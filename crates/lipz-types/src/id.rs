//! Clip ids: the 64-bit hash of a clip's key, computable at compile time.

use crate::UnknownName;
use crate::hash::{FINISH, STEP, mix};
use core::fmt;
use core::str::FromStr;

/// 64-bit hash of a clip's key.
///
/// The compiler checks that no two clips of a bank share an id. Within a bank, an id is therefore as good as the key,
/// and takes eight bytes instead of a string.
///
/// ```
/// use lipz_types::ClipId;
/// const HELLO: ClipId = ClipId::from_key("act1/samson-hello");
/// assert_eq!(HELLO.get(), 0xffff_95a9_0441_eeda);
/// ```
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ClipId(u64);

impl ClipId {
    /// Returns the id of `key`, the path of a Lipz file below its source root, with `/` and without extension.
    ///
    /// The function is FNV-1a, widened to eight bytes per step, with the high half folded down after each
    /// multiplication. `docs/reference/bank-format.md`, "Clip ids", has a specification with test vectors.
    #[inline]
    pub const fn from_key(key: &str) -> ClipId {
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

    /// Returns the id with this value, as stored in generated headers and in banks.
    pub const fn from_u64(value: u64) -> ClipId {
        ClipId(value)
    }

    /// Returns the value of the id.
    pub const fn get(self) -> u64 {
        self.0
    }
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

/// Parses sixteen hexadecimal digits, as [`Display`](fmt::Display) writes them. A leading `0x` is allowed.
impl FromStr for ClipId {
    type Err = UnknownName;

    fn from_str(text: &str) -> Result<ClipId, UnknownName> {
        let digits = text.strip_prefix("0x").unwrap_or(text);
        let are_digits = digits.len() == 16 && digits.bytes().all(|digit| digit.is_ascii_hexdigit());
        match u64::from_str_radix(digits, 16) {
            Ok(value) if are_digits => Ok(ClipId(value)),
            _ => Err(UnknownName::new("clip id", "sixteen hexadecimal digits")),
        }
    }
}

impl From<u64> for ClipId {
    fn from(value: u64) -> ClipId {
        ClipId(value)
    }
}

impl From<ClipId> for u64 {
    fn from(id: ClipId) -> u64 {
        id.0
    }
}

impl fmt::LowerHex for ClipId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::LowerHex::fmt(&self.0, f)
    }
}

impl fmt::UpperHex for ClipId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::UpperHex::fmt(&self.0, f)
    }
}
