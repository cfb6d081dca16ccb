//! Errors of banks: a stable number and a byte offset.

use core::fmt;

/// The damage that [`Bank::open`](crate::Bank::open) or [`Bank::verify`](crate::Bank::verify) found.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Error {
    kind: ErrorKind,
    offset_bytes: u32,
}

impl Error {
    pub(crate) const fn new(kind: ErrorKind, offset_bytes: u32) -> Error {
        Error { kind, offset_bytes }
    }

    /// Returns the kind of damage.
    pub const fn kind(self) -> ErrorKind {
        self.kind
    }

    /// Returns the position of the damage, in bytes from the start of the bank.
    pub const fn offset_bytes(self) -> u32 {
        self.offset_bytes
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} (bank error {}, at byte {})", self.kind.message(), self.kind.number(), self.offset_bytes)
    }
}

#[cfg(feature = "std")]
impl std::error::Error for Error {}

macro_rules! error_kinds {
    ($($(#[doc = $doc:literal])+ $name:ident = $number:literal, $message:literal;)+) => {
        /// The kinds of damage, by stable number. Numbers are never reused, and there are no gaps.
        #[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
        #[non_exhaustive]
        #[repr(u8)]
        pub enum ErrorKind {
            $($(#[doc = $doc])+ $name = $number,)+
        }

        impl ErrorKind {
            /// Every kind, in the order of the numbers.
            pub const ALL: &'static [ErrorKind] = &[$(ErrorKind::$name),+];

            /// Returns the number of the kind, which is never reused.
            pub const fn number(self) -> u8 {
                self as u8
            }

            /// Returns an English sentence about the kind, without a full stop.
            pub const fn message(self) -> &'static str {
                match self {
                    $(ErrorKind::$name => $message,)+
                }
            }
        }
    };
}

error_kinds! {
    /// Fewer bytes than a header has.
    TooShort = 1, "the file is shorter than the header of a bank";
    /// The first bytes are not those of a bank.
    NotABank = 2, "the file is not a lipz bank";
    /// The first bytes are those of a bank after a line-ending conversion.
    TextMode = 3, "the bank was damaged by a copy in text mode (line endings were converted)";
    /// The major format version differs from that of this reader.
    UnsupportedVersion = 4, "the bank has a format version that this reader does not support";
    /// The length in the header is not the length of the bytes.
    WrongLength = 5, "the file does not have the length in its header (cut off, or with bytes appended)";
    /// The directory does not fit into the file.
    DirectoryOutOfBounds = 6, "the directory reaches past the end of the file";
    /// A section does not fit into the file.
    SectionOutOfBounds = 7, "a section reaches past the end of the file";
    /// The entry size or the length of a section is wrong for its tag.
    SectionShape = 8, "the entry size or the length of a section is wrong";
    /// A required section of format 1 is absent.
    SectionMissing = 9, "a section that every bank has is missing";
    /// A section is required but unknown, or known but out of order.
    SectionUnknown = 10, "the bank needs a newer reader (a required section is unknown or out of order)";
    /// A tag appears in the directory twice.
    SectionTwice = 11, "a section appears twice in the directory";
    /// The checksum differs.
    Checksum = 12, "the checksum does not match: the file was changed or damaged";
    /// The clip index does not lead to the clip.
    ClipIndex = 13, "the clip index does not lead to the key record";
    /// The key of a clip is outside its pool, or its hash is not the clip's id.
    ClipKey = 14, "the key of a clip does not match its id";
    /// The order table does not name the clips in the order of their keys.
    ClipOrder = 15, "the clips are not listed in the order of their keys";
    /// The frames of a clip do not follow those of the clip before it, or are outside their section.
    FrameRange = 16, "the frames of a clip have a wrong offset";
    /// A frame code is invalid in the clip's viseme type.
    FrameCode = 17, "a frame code is not one of the clip's viseme type";
    /// The frame rate is outside 1 to 1000 or its reciprocal is wrong.
    FrameRate = 18, "the frame rate of a clip is not valid";
    /// The viseme type or a flag of a clip is unknown.
    ClipFlags = 19, "a clip has an unknown viseme type or flag";
    /// The segment starts of a clip are missing, decrease, or are past its end.
    SegmentStarts = 20, "the segment starts of a clip are not valid";
    /// A text reference or the end of a text is not valid.
    TextReference = 21, "a text reference is not valid";
    /// A string pool is not UTF-8.
    Utf8 = 22, "a string pool is not valid UTF-8";
    /// An event reference is not valid.
    EventReference = 23, "an event reference is not valid";
    /// The locales are not listed in the order of their tags, or a tag is outside its pool.
    LocaleOrder = 24, "the locales are not listed in the order of their tags";
    /// A section overlaps another, leaves a gap, or does not start at a multiple of 64.
    SectionPlace = 25, "a section is not at the first multiple of 64 after the one before it";
    /// The directory has more than 64 entries.
    DirectoryTooLong = 26, "the directory has more than 64 sections";
    /// The fingerprint does not match the clips.
    Fingerprint = 27, "the fingerprint does not match the clips";
    /// The fingerprint of a text bank does not match the bank.
    OtherClips = 28, "the texts belong to a bank with other clips";
    /// A text bank was opened as a bank.
    TextsOnly = 29, "the file contains only texts, for the clips of another bank";
    /// A typed event has an unknown verb, refers to no name, or does not follow the one before it.
    TypedEvent = 30, "a typed event is not valid";
    /// The names of typed events are not listed in their order, or one is outside its pool.
    EventName = 31, "the names in events are not listed in their order";
    /// A babble profile is cut off, out of order, or has a string that is not digits.
    Babble = 32, "a babble profile is not valid";
    /// Texts cannot be verified, because their bank was not verified.
    BankNotVerified = 33, "the bank of the texts was not verified";
    /// A recording's record is neither a length with a hash nor empty.
    Recording = 34, "the record of a recording is not valid";
    /// A curve has no name or no keys, its keys do not ascend or are after the end of the clip, or it is misplaced.
    Curve = 35, "a curve is not valid";
    /// A layer's description of the banks below it is cut off, out of order, or refers to missing data.
    Layer = 36, "the description of the banks below a patch is not valid";
    /// A layer is not on top of the banks that it was packed over: one is missing, has a different version, or is above
    /// it.
    OtherBase = 37, "the patch was packed over different banks from those below it";
    /// A bank above the first one was not packed as a layer.
    NotALayer = 38, "the bank is not a patch, because it was not packed over another bank";
    /// There are no banks, or more than the program has room for.
    LayerCount = 39, "the number of banks is 0, or more than the program has room for";
    /// The voices are not listed in their order, or a dub does not belong to its original.
    Voice = 40, "a voice or a dub is not valid";
    /// A face profile is cut off, out of order, or has a number outside its range.
    Face = 41, "a face profile is not valid";
    /// The first bytes are not those of the index of a set.
    NotASet = 42, "the file is not the index of a set of banks";
    /// The index of a set has an invalid name, clips out of order, or too many banks.
    Set = 43, "the description of the banks in the index of a set is not valid";
    /// A bank of a set is not the one that its index names, or contains clips of a different bank.
    OtherBank = 44, "the banks are not those of the set in its order";
    /// The phones of a clip are out of order, or an articulation profile is not valid.
    Phones = 45, "the phones of a clip or an articulation profile are not valid";
    /// A rig has an unknown input, or its names or terms do not follow each other.
    Rig = 46, "a rig is not valid";
}
