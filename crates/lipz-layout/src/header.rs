//! The header of a bank and the directory of its sections.

use super::{U16, U32, U64};
use crate::records::records;

/// Offset of the first byte that the checksum covers: everything except the magic and the checksum itself.
pub const CHECKED_FROM: usize = 16;

/// Sections start at multiples of a cache line, with only the necessary zeros before them.
pub const SECTION_ALIGNMENT: u32 = 64;

/// The maximal number of sections in a bank.
pub const MAX_SECTIONS: usize = 64;

/// Flag of a section that a reader must know to use the bank.
pub const SECTION_REQUIRED: u16 = 1;

/// The four ASCII letters that name a section.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Tag(pub [u8; 4]);

records! {
    /// The first 64 bytes of a bank.
    Header: 64 {
        /// [`MAGIC`](super::MAGIC).
        magic: [u8; 8],
        /// [`checksum`](super::checksum) of every byte from [`CHECKED_FROM`] on.
        checksum: U64,
        /// Length of the whole file in bytes.
        file_length_bytes: U32,
        /// [`FORMAT_MAJOR`](super::FORMAT_MAJOR).
        format_major: U16,
        /// [`FORMAT_MINOR`](super::FORMAT_MINOR) of the writer.
        format_minor: U16,
        /// Hash of the clip ids and segment counts in slot order. Files that belong together share it.
        fingerprint: U64,
        /// Seed of the clip index, see [`spread`](super::spread).
        index_seed: U64,
        /// Number of entries in the directory, which follows the header.
        section_count: U32,
        /// Zero.
        reserved: [u8; 20],
    }

    /// One section of the bank: 16 bytes of the directory.
    DirectoryEntry: 16 {
        /// Four ASCII letters, see [`Tag`].
        tag: [u8; 4],
        /// Offset of the section in the file: a multiple of 64, so that no record of a clip crosses a cache line.
        offset_bytes: U32,
        /// Length of the section in bytes.
        length_bytes: U32,
        /// Length of one entry in bytes; 1 for pools and byte streams.
        entry_bytes: U16,
        /// [`SECTION_REQUIRED`] or 0.
        flags: U16,
    }
}
