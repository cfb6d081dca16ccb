"""Phones: the units of speech of a clip, with their times."""

from __future__ import annotations

import struct

from .curves import place_of
from .file import File, u32s

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .clip import Clip

# The names of the phones in the order of their numbers: ARPAbet, or else IPA.
PHONES = tuple(
    """
    sil AA AE AH AO AW AY B CH D DH EH ER EY F G HH IH IY JH K L M N NG OW OY P R S SH T TH UH UW V W Y
    Z ZH y ʏ ɨ ʉ ɯ e ø ɘ ɵ ɤ o AX œ ɜ ɞ AXR ɐ a ɶ ɒ ɛ̃ œ̃ ɔ̃ ɑ̃ ɐ̃ ẽ ĩ õ ũ ɸ β ʙ ɱ ʋ pf WH ɥ ts dz DX r
    ɬ ɮ ɕ ʑ tɕ dʑ ʂ ʐ tʂ dʐ ʈ ɖ ɳ ɭ ɽ ɻ ɫ c ɟ ɲ ç ʝ ʎ x ɣ ɰ q ɢ ɴ χ ʁ ʀ ħ ʕ Q ɦ ɧ
    """.split()
)
SILENCE = 0
_OFFSET = 0x3FFF_FFFF
_ARE_CERTAIN = 0x4000_0000
_ARE_WIDE = 0x8000_0000
_NO_LEVEL = -128
_RECORD_BYTES = 8
# The length of the last phone of a clip without frames, in milliseconds.
_LAST_MS = 100


class Phones:
    """The phones of a clip.

    `numbers` and `starts_ms` have an entry for each phone. The last phone ends at `end_ms`. `level_db` is the level of
    the speech in decibels relative to full scale, or None. Phones `are_certain` if they come from the text of the
    recording.
    """

    __slots__ = ("numbers", "starts_ms", "end_ms", "level_db", "are_certain")

    def __init__(
        self, numbers: list[int], starts_ms: list[int], end_ms: int, level_db: int | None, are_certain: bool
    ) -> None:
        self.numbers = numbers
        self.starts_ms = starts_ms
        self.end_ms = end_ms
        self.level_db = level_db
        self.are_certain = are_certain

    def __len__(self) -> int:
        return len(self.numbers)

    def __str__(self) -> str:
        names = (PHONES[number] if number < len(PHONES) else "?" for number in self.numbers)
        return " ".join(f"{name}@{start}" for name, start in zip(names, self.starts_ms))


class PhoneTable:
    """The phones of all clips of a bank."""

    __slots__ = ("_clips", "_bytes", "_last")

    def __init__(self, file: File) -> None:
        clips = file.section(b"PHNC")
        self._clips = u32s(clips[: len(clips) // _RECORD_BYTES * _RECORD_BYTES])
        self._bytes = file.section(b"PHON")
        # The phones that were read last, and their clip, because a program draws a clip for many frames.
        self._last: tuple[Clip, Phones] | None = None

    def of(self, clip: Clip) -> Phones:
        """Returns the phones of a clip."""
        if self._last is None or self._last[0] is not clip:
            self._last = clip, self._read(clip)
        return self._last[1]

    def _read(self, clip: Clip) -> Phones:
        place = place_of(self._clips, clip.slot)
        if place is None:
            return Phones([], [], 0, None, True)
        flags: int = self._clips[2 * place + 1]
        behind = 2 * place + 3
        end = self._clips[behind] & _OFFSET if behind < len(self._clips) else len(self._bytes)
        data = self._bytes[flags & _OFFSET : end]
        level = struct.unpack_from("<b", data)[0] if len(data) else _NO_LEVEL
        entry = struct.Struct("<BI" if flags & _ARE_WIDE else "<BH")
        phones = list(entry.iter_unpack(data[1 : 1 + max(len(data) - 1, 0) // entry.size * entry.size]))
        starts_ms = [start_ms for _, start_ms in phones]
        if clip.fps is not None and clip.frame_count > 0:
            end_ms = clip.fps.start_of_frame_us(clip.frame_count) // 1000
        else:
            end_ms = (starts_ms[-1] if starts_ms else 0) + _LAST_MS
        level_db = None if level == _NO_LEVEL else level
        return Phones([number for number, _ in phones], starts_ms, end_ms, level_db, flags & _ARE_CERTAIN != 0)
