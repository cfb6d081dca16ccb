//! LIP files of version 2, exactly: every byte is kept, also those that mean nothing to the game.
//!
//! The layout is that of "A Description of the LIP File Format v2 Used in Fallout 2", which does not
//! say that every word is big-endian. docs/guides/fallout-and-second-life.md has it as lipz reads it.

mod oddities;
mod read;
mod write;

use std::ops::Range;

/// The version that the game reads.
const VERSION: u32 = 2;

/// Places of the header, in bytes.
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

/// Bytes before the phonemes.
const HEADER_BYTES: usize = offset::EXTENSION.end;

/// Bytes of a marker: type and position.
const MARKER_BYTES: usize = 8;

/// Bytes of the name of a sound.
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
    /// The word at 0x08. While the game runs: bit 0 to start again instead of stopping at the last
    /// marker, bit 1 while it plays.
    pub flags: u32,
    /// The word at 0x0C, without a known meaning.
    pub unknown_0c: u32,
    /// The word at 0x10 as it is stored; [`Lip::length`] interprets it.
    pub length_word: [u8; 4],
    /// The word at 0x18, without a known meaning.
    pub unknown_18: u32,
    /// Name of the sound, filled with NUL.
    pub name: [u8; NAME_BYTES],
    /// Extension of the sound: [`Lip::EXTENSION`] in all known files, although the sounds are ACM.
    pub extension: [u8; 4],
    /// Codes of the phonemes.
    pub phonemes: Vec<u8>,
    /// Where each phoneme starts, and at last where the speech ends.
    pub markers: Vec<Marker>,
    /// What follows the last marker; nothing in all known files.
    pub trailing: Vec<u8>,
}

/// A place in the sound.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Marker {
    /// 1 at silence and at the start of a word, 0 inside of a word.
    pub kind: u32,
    /// Bytes of decoded sound before it.
    pub position: u32,
}

/// How the bytes of a word are ordered.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum ByteOrder {
    /// As all words should be.
    Big,
    /// As the word at 0x10 is in most files of the game.
    Little,
}

/// What the word at 0x10 says.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Length {
    /// Bytes of decoded sound.
    pub bytes: u32,
    /// The order in which it was read.
    pub order: ByteOrder,
}

impl Lip {
    /// What the word at 0x04 is.
    pub const CONSTANT: u32 = 0x5800;

    /// What the extension is.
    pub const EXTENSION: [u8; 4] = *b"VOC\0";

    /// A file as the game's own are, for a sound that ends at the last marker.
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

    /// The length of the sound, read in the order in which it is the position of the last marker; if
    /// it is that in neither, in the order that comes nearer to it.
    pub fn length(&self) -> Length {
        let end = self.markers.last().map_or(0, |marker| marker.position);
        let big = Length { bytes: u32::from_be_bytes(self.length_word), order: ByteOrder::Big };
        let little = Length { bytes: u32::from_le_bytes(self.length_word), order: ByteOrder::Little };
        if little.bytes.abs_diff(end) < big.bytes.abs_diff(end) { little } else { big }
    }

    /// The position at which the speech ends: that of the last marker, or of one before it if it runs
    /// backwards.
    pub fn end(&self) -> u32 {
        self.markers.iter().map(|marker| marker.position).max().unwrap_or(0)
    }

    /// The name of the sound: the bytes before the first NUL. Other bytes than ASCII are replaced.
    pub fn sound(&self) -> String {
        let end = self.name.iter().position(|&byte| byte == 0).unwrap_or(self.name.len());
        let name = self.name.get(..end).unwrap_or_default();
        name.iter().map(|&byte| if byte.is_ascii() { char::from(byte) } else { char::REPLACEMENT_CHARACTER }).collect()
    }

    /// Where the phoneme with this number is in the file, in bytes.
    fn phoneme_place(index: usize) -> Range<usize> {
        HEADER_BYTES + index..HEADER_BYTES + index + 1
    }

    /// Where the marker with this number is in the file, in bytes.
    fn marker_place(&self, index: usize) -> Range<usize> {
        let start = HEADER_BYTES + self.phonemes.len() + index * MARKER_BYTES;
        start..start + MARKER_BYTES
    }
}
