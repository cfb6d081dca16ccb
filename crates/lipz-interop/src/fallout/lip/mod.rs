//! LIP files of version 2, without loss: every byte is kept, even if the game ignores it.
//!
//! The layout comes from "A Description of the LIP File Format v2 Used in Fallout 2", which omits that every word is
//! big-endian. docs/guides/fallout-and-second-life.md describes the layout as lipz reads it.

mod oddities;
mod read;
mod write;

use std::ops::Range;

/// The version supported by the game.
const VERSION: u32 = 2;

/// Offsets in the header, in bytes.
mod offset {
    use std::ops::Range;

    pub(super) const VERSION: Range<usize> = 0x00..0x04;
    pub(super) const CONSTANT: Range<usize> = 0x04..0x08;
    pub(super) const FLAGS: Range<usize> = 0x08..0x0C;
    pub(super) const UNKNOWN_0C: Range<usize> = 0x0C..0x10;
    pub(super) const LENGTH: Range<usize> = 0x10..0x14;
    pub(super) const PHONEME_COUNT: Range<usize> = 0x14..0x18;
    pub(super) const UNKNOWN_18: Range<usize> = 0x18..0x1C;
    pub(super) const MARKER_COUNT: Range<usize> = 0x1C..0x20;
    pub(super) const NAME: Range<usize> = 0x20..0x28;
    pub(super) const EXTENSION: Range<usize> = 0x28..0x2C;
}

/// The offset of the phonemes in bytes.
const HEADER_BYTES: usize = offset::EXTENSION.end;

/// The size of a marker in bytes: type and position.
const MARKER_BYTES: usize = 8;

/// The size of the name of a recording in bytes.
pub const NAME_BYTES: usize = 8;

/// A LIP file of version 2.
///
/// ```
/// use lipz_interop::fallout::lip::{Lip, Marker};
/// let markers = [(1, 0), (0, 9800), (1, 22050)].map(|(kind, position)| Marker { kind, position });
/// let lip = Lip::new(*b"ELD_1\0\0\0", vec![0x12, 0x01], markers.to_vec());
/// assert_eq!(Lip::read(&lip.write()), Ok(lip));
/// ```
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Lip {
    /// The word at 0x04: [`Lip::CONSTANT`] in all known files.
    pub constant: u32,
    /// The word at 0x08. While the game runs, bit 0 means to start again at the last marker instead of stopping, and
    /// bit 1 that it is playing.
    pub flags: u32,
    /// The word at 0x0C, whose meaning is unknown.
    pub unknown_0c: u32,
    /// The stored word at 0x10; [`Lip::length`] interprets it.
    pub length_word: [u8; 4],
    /// The word at 0x18, whose meaning is unknown.
    pub unknown_18: u32,
    /// The name of the recording, padded with NUL.
    pub name: [u8; NAME_BYTES],
    /// The extension of the recording: [`Lip::EXTENSION`] in all known files, although the recordings are ACM.
    pub extension: [u8; 4],
    /// The codes of the phonemes.
    pub phonemes: Vec<u8>,
    /// The start of each phoneme, and finally the end of the speech.
    pub markers: Vec<Marker>,
    /// The bytes after the last marker; empty in all known files.
    pub trailing: Vec<u8>,
}

/// A position in the recording.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Marker {
    /// 1 at silence and at the start of a word, 0 inside a word.
    pub kind: u32,
    /// The number of bytes of decoded audio before it.
    pub position: u32,
}

/// The byte order of a word.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum ByteOrder {
    /// Big-endian, as required for all words.
    Big,
    /// Little-endian, as used for the word at 0x10 in most files of the game.
    Little,
}

/// The interpreted word at 0x10.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Length {
    /// Bytes of decoded audio.
    pub bytes: u32,
    /// The byte order in which it was read.
    pub order: ByteOrder,
}

impl Lip {
    /// The usual word at 0x04.
    pub const CONSTANT: u32 = 0x5800;

    /// The usual extension.
    pub const EXTENSION: [u8; 4] = *b"VOC\0";

    /// Returns a file like the game's own, for a recording that ends at the last marker.
    pub fn new(name: [u8; NAME_BYTES], phonemes: Vec<u8>, markers: Vec<Marker>) -> Lip {
        let end = markers.last().map_or(0, |marker| marker.position);
        Lip {
            constant: Lip::CONSTANT,
            flags: 0,
            unknown_0c: 0,
            length_word: end.to_be_bytes(),
            unknown_18: 0,
            name,
            extension: Lip::EXTENSION,
            phonemes,
            markers,
            trailing: Vec::new(),
        }
    }

    /// Returns the length of the recording, read in the byte order in which it equals the position of the last marker,
    /// or else in the order that comes closer to it.
    pub fn length(&self) -> Length {
        let end = self.markers.last().map_or(0, |marker| marker.position);
        let big = Length { bytes: u32::from_be_bytes(self.length_word), order: ByteOrder::Big };
        let little = Length { bytes: u32::from_le_bytes(self.length_word), order: ByteOrder::Little };
        if little.bytes.abs_diff(end) < big.bytes.abs_diff(end) { little } else { big }
    }

    /// Returns the position of the end of the speech: that of the last marker, or of an earlier one if positions run
    /// backwards.
    pub fn end(&self) -> u32 {
        self.markers.iter().map(|marker| marker.position).max().unwrap_or(0)
    }

    /// Returns the name of the recording: the bytes before the first NUL, with non-ASCII bytes replaced.
    pub fn sound(&self) -> String {
        let end = self.name.iter().position(|&byte| byte == 0).unwrap_or(self.name.len());
        let name = self.name.get(..end).unwrap_or_default();
        name.iter().map(|&byte| if byte.is_ascii() { char::from(byte) } else { char::REPLACEMENT_CHARACTER }).collect()
    }

    /// Returns the offset in the file of the phoneme with this index, in bytes.
    fn phoneme_place(index: usize) -> Range<usize> {
        HEADER_BYTES + index..HEADER_BYTES + index + 1
    }

    /// Returns the offset in the file of the marker with this index, in bytes.
    fn marker_place(&self, index: usize) -> Range<usize> {
        let start = HEADER_BYTES + self.phonemes.len() + index * MARKER_BYTES;
        start..start + MARKER_BYTES
    }
}
