//! The header of a bank and the directory of its sections.

use super::{U16, U32, U64};
use core::mem::size_of;
use zerocopy::{FromBytes, Immutable, IntoBytes, KnownLayout, Unaligned};

/// Offset of the first byte that the checksum covers: all but the magic and the checksum itself.
pub const CHECKED_FROM: usize = 16;

/// The first 64 bytes of a bank.
#[derive(FromBytes, IntoBytes, Immutable, KnownLayout, Unaligned, Clone, Copy, Debug)]
#[repr(C)]
pub struct Header {
    /// [`MAGIC`](super::MAGIC).
    pub magic: [u8; 8],
    /// [`checksum`](super::checksum) of every byte from [`CHECKED_FROM`] on.
    pub checksum: U64,
    /// Length of the whole file.
    pub file_length_bytes: U32,
    /// [`FORMAT_MAJOR`](super::FORMAT_MAJOR).
    pub format_major: U16,
    /// [`FORMAT_MINOR`](super::FORMAT_MINOR) of the writer.
    pub format_minor: U16,
    /// Hash of the clip ids and segment counts in slot order: files that belong together share it.
    pub fingerprint: U64,
    /// Start value of the clip index, see [`spread`](super::spread).
    pub index_seed: U64,
    /// Entries in the directory, which follows the header.
    pub section_count: U32,
    /// Zero.
    pub reserved: [u8; 20],
}

/// One section of the bank: 16 bytes of the directory.
#[derive(FromBytes, IntoBytes, Immutable, KnownLayout, Unaligned, Clone, Copy, Debug)]
#[repr(C)]
pub struct DirectoryEntry {
    /// Four ASCII letters, see [`Tag`].
    pub tag: [u8; 4],
    /// Where the section starts in the file; a multiple of 64, so that no record of a clip crosses
    /// a cache line.
    pub offset_bytes: U32,
    /// Length of the section.
    pub length_bytes: U32,
    /// Length of one entry; 1 for pools and byte streams.
    pub entry_bytes: U16,
    /// [`SECTION_REQUIRED`] or 0.
    pub flags: U16,
}

/// Sections start at multiples of a cache line, with no more than the needed zeros before them.
pub const SECTION_ALIGNMENT: u32 = 64;

/// Sections that a bank can have.
pub const MAX_SECTIONS: usize = 64;

/// Flag of a section that a reader must know to use the bank.
pub const SECTION_REQUIRED: u16 = 1;

/// Tags of the sections of format 1.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Tag(pub [u8; 4]);

impl Tag {
    /// [`ClipRecord`](super::ClipRecord)s in slot order.
    pub const CLIPS: Tag = Tag(*b"CLIP");
    /// [`KeyRecord`](super::KeyRecord)s in slot order.
    pub const KEYS: Tag = Tag(*b"KEYS");
    /// [`RateRecord`](super::RateRecord)s: the distinct non-integer frame rates.
    pub const RATES: Tag = Tag(*b"RATE");
    /// Pilots of the clip index, one `u32` per bucket.
    pub const PILOTS: Tag = Tag(*b"PILT");
    /// Slots of the clips in the order of their keys (bytewise), one `u32` each.
    pub const KEY_ORDER: Tag = Tag(*b"ORDR");
    /// Pool of keys and locale tags, UTF-8.
    pub const NAMES: Tag = Tag(*b"NAME");
    /// Frame codes, one byte each.
    pub const FRAMES: Tag = Tag(*b"FRAM");
    /// Segment starts: for each segment of all clips the offset of its first frame in `FRAM`, one `u32` each,
    /// and behind them the length of `FRAM`.
    pub const STARTS: Tag = Tag(*b"STRT");
    /// [`LocaleRecord`](super::LocaleRecord)s in the order of their tags.
    pub const LOCALES: Tag = Tag(*b"LOCL");
    /// Text starts: for each locale in turn, where the text of each segment of all clips starts in `TEXT`, one
    /// `u32` each, and behind them the length of `TEXT`.
    pub const TEXT_STARTS: Tag = Tag(*b"TXST");
    /// Text pool, UTF-8: display texts, each locale's together.
    pub const TEXTS: Tag = Tag(*b"TEXT");
    /// For each segment of the clips with events, which come first, the number of an event record, one
    /// `u32` each.
    pub const EVENT_REFS: Tag = Tag(*b"EVRF");
    /// [`EventRecord`](super::EventRecord)s: the distinct event strings.
    pub const EVENTS: Tag = Tag(*b"EVNT");
    /// [`TypedEventRecord`](super::TypedEventRecord)s: what each event string in turn is made of.
    pub const TYPED_EVENTS: Tag = Tag(*b"EVTY");
    /// [`EventNameRecord`](super::EventNameRecord)s in the order of the names (bytewise).
    pub const EVENT_NAMES: Tag = Tag(*b"EVNM");
    /// Pool of event strings and the names in them, UTF-8.
    pub const EVENT_STRINGS: Tag = Tag(*b"EVST");
    /// Optional: [`BabbleRecord`](super::BabbleRecord)s in the order of their names (bytewise), each with its strings.
    pub const BABBLE: Tag = Tag(*b"BABL");
    /// Optional: [`FaceRecord`](super::FaceRecord)s in the order of their names (bytewise), each with its name.
    pub const FACES: Tag = Tag(*b"FACE");
    /// Optional: [`RecordingRecord`](super::RecordingRecord)s in slot order.
    pub const RECORDINGS: Tag = Tag(*b"RCRD");
    /// Optional: [`CurveClipRecord`](super::CurveClipRecord)s of the clips with curves, in slot order.
    pub const CURVE_CLIPS: Tag = Tag(*b"CRVC");
    /// Optional: [`CurveRecord`](super::CurveRecord)s, each clip's in the order of their names.
    pub const CURVES: Tag = Tag(*b"CURV");
    /// Optional: [`CurveKeyRecord`](super::CurveKeyRecord)s or [`WideCurveKeyRecord`](super::WideCurveKeyRecord)s of each
    /// curve in turn.
    pub const CURVE_KEYS: Tag = Tag(*b"CRVK");
    /// Optional: the locales of the voices, each with a zero byte behind it; first that of the original, then those of the
    /// dubs in the order of their bytes.
    pub const VOICES: Tag = Tag(*b"VOIC");
    /// Optional: for each voice but the original in turn, what stands for the clip in each slot, one `u32` each:
    /// [`NO_DUB`](super::NO_DUB), or a slot with [`DUB_OF`](super::DUB_OF), [`OTHER_DUB`](super::OTHER_DUB) or neither.
    pub const DUBS: Tag = Tag(*b"DUBS");
    /// Optional: where each clip's source record starts in `SRCE`, one `u32` per slot.
    pub const SOURCE_INDEX: Tag = Tag(*b"SRCX");
    /// Optional: what the display form lost of each Lipz file. Only the compiler reads it.
    pub const SOURCES: Tag = Tag(*b"SRCE");

    /// Optional: a [`LayerRecord`](super::LayerRecord) and its tables. The bank is a layer over others.
    pub const LAYER: Tag = Tag(*b"LAYR");
    /// Only in objects, which are linked to a bank: what they say beside being one, as JSON.
    pub const EXPORT: Tag = Tag(*b"XPRT");

    /// Only in indices of sets: [`SetBankRecord`](super::SetBankRecord)s in the order of the shards.
    pub const SET_BANKS: Tag = Tag(*b"SETB");
    /// Only in indices of sets: the ids of clips that are not in the bank of their id, ascending, one `u64` each.
    pub const SET_MOVED: Tag = Tag(*b"SETM");
    /// Only in indices of sets: the number of the bank that each of these clips is in, one `u16` each.
    pub const SET_HOMES: Tag = Tag(*b"SETH");

    /// The sections of the index of a set, with the length of an entry, in file order.
    pub const SET: [(Tag, usize); 4] = [
        (Tag::SET_BANKS, size_of::<super::SetBankRecord>()),
        (Tag::SET_MOVED, 8),
        (Tag::SET_HOMES, 2),
        (Tag::NAMES, 1),
    ];

    /// The sections that a bank of format 1 may have, with the length of an entry, in file order.
    pub const OPTIONAL: [(Tag, usize); 11] = [
        (Tag::BABBLE, 1),
        (Tag::FACES, 1),
        (Tag::RECORDINGS, size_of::<super::RecordingRecord>()),
        (Tag::CURVE_CLIPS, size_of::<super::CurveClipRecord>()),
        (Tag::CURVES, size_of::<super::CurveRecord>()),
        (Tag::CURVE_KEYS, size_of::<super::CurveKeyRecord>()),
        (Tag::VOICES, 1),
        (Tag::DUBS, 4),
        (Tag::SOURCE_INDEX, 4),
        (Tag::SOURCES, 1),
        (Tag::LAYER, 1),
    ];

    /// The sections that every bank has, with the length of an entry, in file order.
    pub const REQUIRED: [(Tag, usize); 16] = [
        (Tag::CLIPS, size_of::<super::ClipRecord>()),
        (Tag::KEYS, size_of::<super::KeyRecord>()),
        (Tag::RATES, size_of::<super::RateRecord>()),
        (Tag::PILOTS, 4),
        (Tag::KEY_ORDER, 4),
        (Tag::NAMES, 1),
        (Tag::FRAMES, 1),
        (Tag::STARTS, 4),
        (Tag::LOCALES, size_of::<super::LocaleRecord>()),
        (Tag::TEXT_STARTS, 4),
        (Tag::TEXTS, 1),
        (Tag::EVENT_REFS, 4),
        (Tag::EVENTS, size_of::<super::EventRecord>()),
        (Tag::TYPED_EVENTS, size_of::<super::TypedEventRecord>()),
        (Tag::EVENT_NAMES, size_of::<super::EventNameRecord>()),
        (Tag::EVENT_STRINGS, 1),
    ];
}

const _: () = assert!(size_of::<Header>() == 64);
const _: () = assert!(size_of::<DirectoryEntry>() == 16);

// Every length of an entry is a power of two, so that no division tells whether entries fill a section.
#[allow(clippy::indexing_slicing)]
const _: () = {
    let mut place = 0;
    while place < Tag::REQUIRED.len() {
        assert!(Tag::REQUIRED[place].1.is_power_of_two());
        place += 1;
    }
};
