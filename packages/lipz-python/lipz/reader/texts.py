"""The texts of a file, in each of its locales."""

from __future__ import annotations

import struct

from .file import text_of, u32s

NO_TEXT = 0xFFFF_FFFF
_FALLBACK = 0x8000_0000
_HAS_LENGTH = 0x4000_0000
_OFFSET = 0x3FFF_FFFF
_COUNT_BYTES = 3
_LOCALE_DEFAULT = 1


class Text(str):
    """A display text. `is_fallback` is true if it is from a different locale."""

    __slots__ = ("is_fallback",)

    is_fallback: bool


class LocaleTable:
    """The locales of a file and their texts."""

    __slots__ = ("tags", "default", "_starts", "_texts", "_segment_count")

    def __init__(self, sections: dict[bytes, memoryview], segment_count: int) -> None:
        # The tags in ascending order.
        self.tags: list[str] = []
        self.default: str | None = None
        self._starts = u32s(sections[b"TXST"])
        self._texts = sections[b"TEXT"]
        self._segment_count = segment_count
        for start, length, flags in struct.iter_unpack("<IHH", sections[b"LOCL"]):
            tag = text_of(sections[b"NAME"], start, length) or ""
            self.tags.append(tag)
            if flags & _LOCALE_DEFAULT and self.default is None:
                self.default = tag

    def text(self, locale: int, first: int, number: int) -> Text | None:
        """Returns the text of the segment with this number, of a clip whose first segment has the number `first`."""
        starts = self._starts
        at = locale * self._segment_count + number
        if at + 1 >= len(starts) or starts[locale * self._segment_count + first] == NO_TEXT:
            return None
        entry: int = starts[at]
        start = entry & _OFFSET
        if entry & _HAS_LENGTH:
            count = self._texts[start : start + _COUNT_BYTES]
            if len(count) < _COUNT_BYTES:
                return None
            length = (count[0] & 63) << 12 | (count[1] & 63) << 6 | count[2] & 63
            start += _COUNT_BYTES
        else:
            length = (starts[at + 1] & _OFFSET) - start
        found = text_of(self._texts, start, length) if length >= 0 else None
        if found is None:
            return None
        text = Text(found)
        text.is_fallback = entry & _FALLBACK != 0
        return text
