//! Comparison of files with expected contents.

use std::fs::File;
use std::io::{self, BufRead, BufReader, Read};
use std::path::Path;

/// The number of bytes compared at a time.
const AT_ONCE: usize = 1 << 16;

/// Whether the file has exactly these bytes. Reads up to the first difference.
pub(crate) fn has(path: &Path, bytes: &[u8]) -> bool {
    has_all(path, bytes.len() as u64, bytes)
}

/// Whether the file has exactly the bytes of `other`, which has this length.
pub(crate) fn has_all(path: &Path, length_bytes: u64, other: impl Read) -> bool {
    let is_as_long = path.metadata().is_ok_and(|found| found.is_file() && found.len() == length_bytes);
    is_as_long && File::open(path).and_then(|file| are_same(file, other)).unwrap_or(false)
}

fn are_same(one: impl Read, other: impl Read) -> io::Result<bool> {
    let (mut one, mut other) = (BufReader::with_capacity(AT_ONCE, one), BufReader::with_capacity(AT_ONCE, other));
    loop {
        let (next, of_other) = (one.fill_buf()?, other.fill_buf()?);
        let length = next.len().min(of_other.len());
        if length == 0 || next[..length] != of_other[..length] {
            return Ok(next.is_empty() && of_other.is_empty());
        }
        one.consume(length);
        other.consume(length);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_same_bytes_are_the_same() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        let bytes: Vec<u8> = (0..3 * AT_ONCE + 7).map(|at| (at % 251) as u8).collect();
        std::fs::write(&path, &bytes).unwrap();
        // In pieces of different lengths.
        assert!(has(&path, &bytes) && has_all(&path, bytes.len() as u64, bytes[..9].chain(&bytes[9..])));
        for at in [0, AT_ONCE - 1, AT_ONCE, bytes.len() - 1] {
            let mut other = bytes.clone();
            other[at] ^= 1;
            assert!(!has(&path, &other), "{at}");
        }
        assert!(
            !has(&path, &bytes[..bytes.len() - 1]) && !has(folder.path(), b"") && !has(&folder.path().join("b"), b"")
        );
        assert!(!are_same(&bytes[..], &bytes[..9]).unwrap());
    }
}
