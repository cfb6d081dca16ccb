//! Hashes of contents, which identify files in a plan, and results in a store.

use std::fmt::{self, Write};
use std::path::Path;
use std::str::FromStr;
use std::{fs, io};
use twox_hash::XxHash3_128;

/// The 128-bit XXH3 hash of some bytes. Different files have different hashes, except for files constructed to collide.
/// Do not share a store with people you do not trust.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct ContentHash(u128);

impl ContentHash {
    /// Returns the hash of `bytes`.
    pub fn of(bytes: &[u8]) -> ContentHash {
        ContentHash(XxHash3_128::oneshot(bytes))
    }

    /// Returns the hash of a file's contents.
    ///
    /// # Errors
    /// If it cannot be read.
    pub fn of_file(path: &Path) -> io::Result<ContentHash> {
        fs::read(path).map(|bytes| ContentHash::of(&bytes))
    }
}

/// Writes 32 hexadecimal digits.
impl fmt::Display for ContentHash {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:032x}", self.0)
    }
}

impl FromStr for ContentHash {
    type Err = String;

    fn from_str(text: &str) -> Result<ContentHash, String> {
        let is_digit = |byte: u8| matches!(byte, b'0'..=b'9' | b'a'..=b'f');
        match u128::from_str_radix(text, 16) {
            Ok(hash) if text.len() == 32 && text.bytes().all(is_digit) => Ok(ContentHash(hash)),
            _ => Err("a content hash has 32 hexadecimal digits in lower case".to_owned()),
        }
    }
}

impl serde::Serialize for ContentHash {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<'de> serde::Deserialize<'de> for ContentHash {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<ContentHash, D::Error> {
        let text = String::deserialize(deserializer)?;
        text.parse().map_err(serde::de::Error::custom)
    }
}

/// Collects the fields for a hash. Different lists of fields never produce the same bytes.
#[derive(Default)]
pub(super) struct Fields(String);

impl Fields {
    pub(super) fn add(&mut self, field: impl fmt::Display) {
        let field = field.to_string();
        let _ = writeln!(self.0, "{}:{field}", field.len());
    }

    pub(super) fn hash(&self) -> ContentHash {
        ContentHash::of(self.0.as_bytes())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_has_the_hash_of_its_bytes_and_hashes_are_read_back() {
        let file = tempfile::NamedTempFile::new().unwrap();
        for bytes in [&b""[..], b"a", b"another"] {
            fs::write(file.path(), bytes).unwrap();
            let hash = ContentHash::of(bytes);
            assert_eq!(ContentHash::of_file(file.path()).unwrap(), hash);
            assert_eq!(hash.to_string().parse(), Ok(hash));
        }
        for text in ["", "0", &"F".repeat(32), &"0".repeat(33), &format!("+{}", "0".repeat(31))] {
            assert!(text.parse::<ContentHash>().is_err(), "{text}");
        }
    }

    #[test]
    fn fields_do_not_run_together() {
        let hash = |fields: &[&str]| {
            let mut all = Fields::default();
            fields.iter().for_each(|field| all.add(field));
            all.hash()
        };
        assert_ne!(hash(&["a", "b"]), hash(&["ab"]));
        assert_ne!(hash(&["a\n1:b"]), hash(&["a", "b"]));
    }
}
