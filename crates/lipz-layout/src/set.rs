//! The sections of files that are not banks: the index of a set, and objects before they are linked.

use super::{Tag, U32, U64};
use crate::records::records;
use core::mem::size_of;

/// The first eight bytes of the index of a set, which differ from those of a bank.
pub const SET_MAGIC: [u8; 8] = *b"\x89LPS\r\n\x1a\n";

/// The maximal number of banks in a set.
pub const MAX_SET_BANKS: usize = 4096;

impl Tag {
    /// Only in objects, which are linked to a bank: the data that a bank does not contain, as JSON.
    pub const EXPORT: Tag = Tag(*b"XPRT");
    /// Only in indices of sets: [`SetBankRecord`]s in the order of the shards.
    pub const SET_BANKS: Tag = Tag(*b"SETB");
    /// Only in indices of sets: the ids of clips that are not in the bank of their id, ascending, one `u64` each.
    pub const SET_MOVED: Tag = Tag(*b"SETM");
    /// Only in indices of sets: the bank number of each of these clips, one `u16` each.
    pub const SET_HOMES: Tag = Tag(*b"SETH");

    /// The sections of the index of a set, in file order, each with the length of an entry.
    pub const SET: [(Tag, usize); 4] =
        [(Tag::SET_BANKS, size_of::<SetBankRecord>()), (Tag::SET_MOVED, 8), (Tag::SET_HOMES, 2), (Tag::NAMES, 1)];
}

records! {
    /// A bank of a set: 32 bytes.
    SetBankRecord: 32 {
        /// The checksum in its header.
        checksum: U64,
        /// The fingerprint in its header.
        fingerprint: U64,
        /// Its length in bytes.
        length_bytes: U32,
        /// Number of its clips.
        clip_count: U32,
        /// Offset in `NAME` of the name of its file.
        name_offset_bytes: U32,
        /// Length of the name in bytes.
        name_length_bytes: U32,
    }
}
