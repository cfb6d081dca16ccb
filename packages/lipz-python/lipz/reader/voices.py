"""Voices: languages with their own recordings, whose visemes are in dubs. Also the lengths of the recordings."""

from __future__ import annotations

import struct

from .file import File, u32s

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .clip import Clip

_NO_DUB = 0xFFFF_FFFF
_DUB_OF = 0x8000_0000
_OTHER_DUB = 0x4000_0000
_NO_RECORDING = 0xFFFF_FFFF_FFFF_FFFF
_RECORDING = struct.Struct("<QQ")


class Recording:
    """The recording that a clip was made for: its length in microseconds, and the XXH3 hash of its file."""

    __slots__ = ("length_us", "content_hash")

    def __init__(self, length_us: int, content_hash: int) -> None:
        self.length_us = length_us
        self.content_hash = content_hash


class VoicedClip:
    """The clip to play in a voice. `spoken` is `dub`, `other-dub` (of a voice it falls back to) or `original`."""

    __slots__ = ("clip", "spoken")

    def __init__(self, clip: Clip, spoken: str) -> None:
        self.clip = clip
        self.spoken = spoken


class VoiceTable:
    """The voices of a bank. `tags` starts with the voice of the originals; it is empty in a bank without dubs."""

    __slots__ = ("tags", "_dubs", "_clip_count", "_recordings")

    def __init__(self, file: File, clip_count: int) -> None:
        dubs = u32s(file.section(b"DUBS"))
        tags = bytes(file.section(b"VOIC")).split(b"\0")[:-1]
        # A damaged bank may lack the table of a voice.
        tables = len(dubs) // clip_count if clip_count else len(tags)
        self.tags = [tag.decode("utf-8", "replace") for tag in tags[: 1 + tables]]
        self._dubs = dubs
        self._clip_count = clip_count
        self._recordings = file.section(b"RCRD")

    def _entry(self, voice: int, slot: int) -> int:
        if voice == 0 or not slot < self._clip_count:
            return _NO_DUB
        entry: int = self._dubs[(voice - 1) * self._clip_count + slot]
        return entry

    def _original_in(self, slot: int) -> tuple[int, int] | None:
        for voice in range(1, len(self.tags)):
            entry = self._entry(voice, slot)
            if entry != _NO_DUB and entry & _DUB_OF:
                return voice, entry & ~_DUB_OF
        return None

    def original_of(self, slot: int) -> int | None:
        """Returns the slot of the clip that the clip in a slot is a dub of."""
        found = self._original_in(slot)
        return None if found is None or found[1] >= self._clip_count else found[1]

    def voice_of(self, slot: int) -> str | None:
        """Returns the voice of the clip in a slot."""
        found = self._original_in(slot)
        return self.tags[found[0] if found else 0] if self.tags else None

    def in_voice(self, slot: int, tag: str) -> tuple[int, str]:
        """Returns the slot of the clip to play in a voice, and the source of its visemes."""
        if tag not in self.tags:
            return slot, "original"
        original = self.original_of(slot)
        original = slot if original is None else original
        entry = self._entry(self.tags.index(tag), original)
        dub = entry & ~_OTHER_DUB
        if dub >= self._clip_count:
            return original, "original"
        return dub, "other-dub" if entry & _OTHER_DUB else "dub"

    def recording(self, slot: int) -> Recording | None:
        """Returns the recording of the clip in a slot."""
        if (slot + 1) * _RECORDING.size > len(self._recordings):
            return None
        length_us, content_hash = _RECORDING.unpack_from(self._recordings, slot * _RECORDING.size)
        return None if length_us == _NO_RECORDING else Recording(length_us, content_hash)
