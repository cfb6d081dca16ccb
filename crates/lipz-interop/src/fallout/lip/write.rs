//! Conversion of a [`Lip`] to bytes.

use super::{HEADER_BYTES, Lip, MARKER_BYTES, VERSION};

impl Lip {
    /// Returns the bytes of the file. A value that was read with [`Lip::read`] produces the same bytes.
    pub fn write(&self) -> Vec<u8> {
        let length = HEADER_BYTES + self.phonemes.len() + self.markers.len() * MARKER_BYTES + self.trailing.len();
        let mut bytes = Vec::with_capacity(length);
        let mut word = |value: [u8; 4]| bytes.extend_from_slice(&value);
        word(VERSION.to_be_bytes());
        word(self.constant.to_be_bytes());
        word(self.flags.to_be_bytes());
        word(self.unknown_0c.to_be_bytes());
        word(self.length_word);
        word(count(self.phonemes.len()));
        word(self.unknown_18.to_be_bytes());
        word(count(self.markers.len()));
        bytes.extend_from_slice(&self.name);
        bytes.extend_from_slice(&self.extension);
        bytes.extend_from_slice(&self.phonemes);
        for marker in &self.markers {
            bytes.extend_from_slice(&marker.kind.to_be_bytes());
            bytes.extend_from_slice(&marker.position.to_be_bytes());
        }
        bytes.extend_from_slice(&self.trailing);
        bytes
    }
}

/// Returns a count as a word. Files are far smaller than it can store.
fn count(number: usize) -> [u8; 4] {
    u32::try_from(number).unwrap_or(u32::MAX).to_be_bytes()
}
