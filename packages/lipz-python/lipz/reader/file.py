"""The parts that all files of the format share: a header, a directory and sections."""

from __future__ import annotations

import struct

from .checksum import checksum_of
from .errors import BankError

MAGIC = b"\x89LPZ\r\n\x1a\n"
FORMAT_MAJOR = 1
HEADER_BYTES = 64
ENTRY_BYTES = 16
MAX_SECTIONS = 64
SECTION_REQUIRED = 1

# The sections of every bank in their order, with the length of an entry.
REQUIRED = (
    (b"CLIP", 16),
    (b"KEYS", 16),
    (b"RATE", 16),
    (b"PILT", 4),
    (b"ORDR", 4),
    (b"NAME", 1),
    (b"FRAM", 1),
    (b"STRT", 4),
    (b"LOCL", 8),
    (b"TXST", 4),
    (b"TEXT", 1),
    (b"EVRF", 4),
    (b"EVNT", 16),
    (b"EVTY", 16),
    (b"EVNM", 8),
    (b"EVST", 1),
)
# The sections of a text bank.
REQUIRED_OF_TEXTS = tuple(entry for entry in REQUIRED if entry[0] in (b"NAME", b"LOCL", b"TXST", b"TEXT"))

_U64 = struct.Struct("<Q")
_LITTLE_ENDIAN = struct.pack("=H", 1) == struct.pack("<H", 1)

TYPE_CHECKING = False
if TYPE_CHECKING:
    from mmap import mmap
    from typing import Union

    Buffer = Union[bytes, bytearray, memoryview, mmap]


class File:
    """A file whose header and directory are checked. The checks take the same time for every length of the file."""

    __slots__ = ("view", "checksum", "fingerprint", "index_seed", "format_version", "directory")

    def __init__(self, data: Buffer) -> None:
        view = memoryview(data).cast("B")
        count = _checked_section_count(view)
        self.view = view
        self.checksum, self.fingerprint, self.index_seed = (u64(view, at) for at in (8, 24, 32))
        self.format_version: tuple[int, int] = struct.unpack_from("<HH", view, 20)
        # Tag, offset, length, length of an entry and flags of each section.
        self.directory = [struct.unpack_from("<4sIIHH", view, HEADER_BYTES + n * ENTRY_BYTES) for n in range(count)]

    @property
    def has_texts_only(self) -> bool:
        """Whether the file starts like a text bank."""
        return bool(self.directory) and self.directory[0][0] == b"NAME"

    def verify_checksum(self) -> None:
        """Compares the checksum with the bytes.

        Raises BankError if the file was changed or damaged.
        """
        if checksum_of(self.view) != self.checksum:
            raise BankError("Checksum", 8)

    def find(self, required: tuple[tuple[bytes, int], ...]) -> dict[bytes, memoryview]:
        """Returns the contents of the required sections, which must be in this order, with the others between them.

        Raises BankError for a section that is missing, damaged or unknown.
        """
        found: dict[bytes, memoryview] = {}
        waiting = iter(required)
        tag, entry_bytes = next(waiting)
        for number, (own_tag, offset, length, own_entry_bytes, flags) in enumerate(self.directory):
            at = HEADER_BYTES + number * ENTRY_BYTES
            if offset + length > len(self.view):
                raise BankError("SectionOutOfBounds", at)
            if own_tag == tag:
                if own_entry_bytes != entry_bytes or length % entry_bytes:
                    raise BankError("SectionShape", at)
                found[tag] = self.view[offset : offset + length]
                tag, entry_bytes = next(waiting, (b"", 1))
            elif flags & SECTION_REQUIRED:
                raise BankError("SectionUnknown", at)
        if tag:
            raise BankError("SectionMissing", 40)
        return found

    def section(self, tag: bytes) -> memoryview:
        """Returns the contents of an optional section, which are empty if it is missing."""
        for own_tag, offset, length, _, _ in self.directory:
            if own_tag == tag:
                return self.view[offset : offset + length]
        return self.view[:0]


def _checked_section_count(view: memoryview) -> int:
    """Checks the header except for the checksum. Returns the number of sections."""
    start = bytes(view[:8])
    if len(view) < HEADER_BYTES:
        is_bank = len(view) < 4 or start[:4] == MAGIC[:4]
        raise BankError("TooShort", len(view)) if is_bank else BankError("NotABank", 0)
    if start != MAGIC:
        raise BankError("TextMode" if start[:4] == MAGIC[:4] else "NotABank", 0)
    length, major = struct.unpack_from("<IH", view, 16)
    if major != FORMAT_MAJOR:
        raise BankError("UnsupportedVersion", 20)
    if length != len(view):
        raise BankError("WrongLength", 16)
    count: int = struct.unpack_from("<I", view, 40)[0]
    if count > MAX_SECTIONS:
        raise BankError("DirectoryTooLong", 40)
    if HEADER_BYTES + count * ENTRY_BYTES > len(view):
        raise BankError("DirectoryOutOfBounds", 40)
    return count


def u64(view: memoryview, at: int) -> int:
    """Returns the number at this offset."""
    value: int = _U64.unpack_from(view, at)[0]
    return value


def u32s(view: memoryview) -> memoryview | tuple[int, ...]:
    """Returns a section as numbers of 32 bits. Bytes after the last whole number are left out."""
    whole = view[: len(view) // 4 * 4]
    if _LITTLE_ENDIAN:
        return whole.cast("I")
    return struct.unpack("<%dI" % (len(whole) // 4), whole)


def text_of(pool: memoryview, start: int, length: int) -> str | None:
    """Returns a string of a pool, or None if it is damaged: outside the pool, or not UTF-8."""
    end = start + length
    if end > len(pool):
        return None
    try:
        return str(pool[start:end], "utf-8")
    except UnicodeDecodeError:
        return None
