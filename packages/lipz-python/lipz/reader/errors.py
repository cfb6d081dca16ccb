"""Errors of banks: a stable number, a kind and the offset of the damage."""

# The kinds of damage in the order of their numbers, which start at 1 (docs/reference/bank-format.md, "Errors").
KINDS = (
    ("TooShort", "the file is shorter than the header of a bank"),
    ("NotABank", "the file is not a lipz bank"),
    ("TextMode", "the bank was damaged by a copy in text mode (line endings were converted)"),
    ("UnsupportedVersion", "the bank has a format version that this reader does not support"),
    ("WrongLength", "the file does not have the length in its header (cut off, or with bytes appended)"),
    ("DirectoryOutOfBounds", "the directory reaches past the end of the file"),
    ("SectionOutOfBounds", "a section reaches past the end of the file"),
    ("SectionShape", "the entry size or the length of a section is wrong"),
    ("SectionMissing", "a section that every bank has is missing"),
    ("SectionUnknown", "the bank needs a newer reader (a required section is unknown or out of order)"),
    ("SectionTwice", "a section appears twice in the directory"),
    ("Checksum", "the checksum does not match: the file was changed or damaged"),
    ("ClipIndex", "the clip index does not lead to the key record"),
    ("ClipKey", "the key of a clip does not match its id"),
    ("ClipOrder", "the clips are not listed in the order of their keys"),
    ("FrameRange", "the frames of a clip have a wrong offset"),
    ("FrameCode", "a frame code is not one of the clip's viseme type"),
    ("FrameRate", "the frame rate of a clip is not valid"),
    ("ClipFlags", "a clip has an unknown viseme type or flag"),
    ("SegmentStarts", "the segment starts of a clip are not valid"),
    ("TextReference", "a text reference is not valid"),
    ("Utf8", "a string pool is not valid UTF-8"),
    ("EventReference", "an event reference is not valid"),
    ("LocaleOrder", "the locales are not listed in the order of their tags"),
    ("SectionPlace", "a section is not at the first multiple of 64 after the one before it"),
    ("DirectoryTooLong", "the directory has more than 64 sections"),
    ("Fingerprint", "the fingerprint does not match the clips"),
    ("OtherClips", "the texts belong to a bank with other clips"),
    ("TextsOnly", "the file contains only texts, for the clips of another bank"),
    ("TypedEvent", "a typed event is not valid"),
    ("EventName", "the names in events are not listed in their order"),
    ("Babble", "a babble profile is not valid"),
    ("BankNotVerified", "the bank of the texts was not verified"),
    ("Recording", "the record of a recording is not valid"),
    ("Curve", "a curve is not valid"),
    ("Layer", "the description of the banks below a patch is not valid"),
    ("OtherBase", "the patch was packed over different banks from those below it"),
    ("NotALayer", "the bank is not a patch, because it was not packed over another bank"),
    ("LayerCount", "the number of banks is 0, or more than the program has room for"),
    ("Voice", "a voice or a dub is not valid"),
    ("Face", "a face profile is not valid"),
    ("NotASet", "the file is not the index of a set of banks"),
    ("Set", "the description of the banks in the index of a set is not valid"),
    ("OtherBank", "the banks are not those of the set in its order"),
    ("Phones", "the phones of a clip or an articulation profile are not valid"),
    ("Rig", "a rig is not valid"),
)
NUMBERS = {kind: number for number, (kind, _) in enumerate(KINDS, 1)}


class BankError(ValueError):
    """A bank cannot be used.

    `code` is the number of the kind, which is never reused. `kind` is its name, such as `WrongLength`. `offset_bytes`
    is the position of the damage from the start of the file.
    """

    code: int
    kind: str
    offset_bytes: int

    def __init__(self, kind: str, offset_bytes: int) -> None:
        self.code = NUMBERS[kind]
        self.kind = kind
        self.offset_bytes = offset_bytes
        message = KINDS[self.code - 1][1]
        super().__init__(f"{message} (bank error {self.code}, at byte {offset_bytes})")

    def __reduce__(self) -> "tuple[type[BankError], tuple[str, int]]":
        return BankError, (self.kind, self.offset_bytes)
