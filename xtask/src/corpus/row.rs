//! A row of `expected.jsonl`.

use crate::Failure;
use serde::Deserialize;
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::path::Path;

/// What a correct reader reports about one file.
#[derive(Clone, Debug, Deserialize)]
pub(super) struct Row {
    path: String,
    key: String,
    sha256: String,
    bytes: usize,
    pub(super) fps: Option<serde_json::Number>,
    pub(super) fps_external: Option<serde_json::Number>,
    pub(super) viseme_type: Option<String>,
    pub(super) viseme_type_external: Option<String>,
    pub(super) frames: usize,
    pub(super) segments: usize,
    pub(super) seg_start_frames: Vec<u32>,
    pub(super) events: Option<Vec<String>>,
    pub(super) locales: Vec<String>,
    pub(super) display: BTreeMap<String, Vec<String>>,
}

impl Row {
    /// Whether the row is about other bytes than these.
    pub(super) fn is_stale(&self, bytes: &[u8]) -> bool {
        bytes.len() != self.bytes || sha256(bytes) != self.sha256
    }
}

/// The hash in hexadecimal digits.
pub(super) fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// The rows by sub-folder and key.
pub(super) fn read(path: &Path) -> Result<BTreeMap<String, BTreeMap<String, Row>>, Failure> {
    let failed = |why: &dyn std::fmt::Display| format!("`{}`: {why}", path.display());
    let text = std::fs::read_to_string(path).map_err(|error| failed(&error))?;
    let mut folders: BTreeMap<String, BTreeMap<String, Row>> = BTreeMap::new();
    for (index, line) in text.lines().enumerate() {
        let row: Row = serde_json::from_str(line).map_err(|error| failed(&format!("row {}: {error}", index + 1)))?;
        let (folder, _) = row.path.split_once('/').ok_or_else(|| failed(&format!("row {}: no folder", index + 1)))?;
        let before = folders.entry(folder.to_owned()).or_default().insert(row.key.clone(), row);
        if let Some(before) = before {
            return Err(failed(&format!("row {}: a second row for `{}`", index + 1, before.key)));
        }
    }
    if folders.is_empty() {
        return Err(failed(&"no rows"));
    }
    Ok(folders)
}

/// The ratio that a decimal number is, in lowest terms. Done here by long hand, so that it does not
/// agree with the parser under test by sharing its mistakes.
pub(super) fn ratio(number: &serde_json::Number) -> Option<(u32, u32)> {
    let decimal = number.to_string();
    let (whole, fraction) = decimal.split_once('.').unwrap_or((&decimal, ""));
    let mut numerator: u64 = format!("{whole}{fraction}").parse().ok()?;
    let mut denominator = 10_u64.checked_pow(u32::try_from(fraction.len()).ok()?)?;
    for prime in [2, 5] {
        while numerator.is_multiple_of(prime) && denominator.is_multiple_of(prime) {
            numerator /= prime;
            denominator /= prime;
        }
    }
    Some((u32::try_from(numerator).ok()?, u32::try_from(denominator).ok()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ratios_of_decimals() {
        let of = |text: &str| ratio(&serde_json::from_str(text).unwrap());
        assert_eq!(of("24"), Some((24, 1)));
        assert_eq!(of("23.976"), Some((2997, 125)));
        assert_eq!(of("29.97"), Some((2997, 100)));
        assert_eq!(of("12.5"), Some((25, 2)));
    }

    #[test]
    fn the_hash_of_the_empty_string() {
        assert_eq!(sha256(b""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    }
}
