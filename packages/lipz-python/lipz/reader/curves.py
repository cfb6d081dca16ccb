"""Curves: named numbers that change while a clip plays."""

from __future__ import annotations

import struct

from .events import EventTable
from .file import File, u32s

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .times import Fps, Time

_WIDE = 0x8000_0000
_PAIR = struct.Struct("<II")


class Curve:
    """A curve of a clip. Between its keys, it is linear. Before the first key and after the last, it is constant."""

    __slots__ = ("name", "_fps", "_frames", "_thousandths")

    def __init__(self, name: str, fps: Fps | None, data: memoryview, is_wide: bool) -> None:
        self.name = name
        self._fps = fps
        format = "<Ii" if is_wide else "<Hh"
        keys = list(struct.iter_unpack(format, data[: len(data) // struct.calcsize(format) * struct.calcsize(format)]))
        self._frames: list[int] = [frame for frame, _ in keys]
        self._thousandths: list[int] = [value for _, value in keys]

    @property
    def keys(self) -> list[tuple[int, float]]:
        """The frame and the value of each key, in ascending order of their frames."""
        return [(frame, value / 1000) for frame, value in zip(self._frames, self._thousandths)]

    def value(self, frame: int) -> float:
        """Returns the value at the start of a frame."""
        return self.thousandths(frame << 16) / 1000

    def value_at(self, time: Time) -> float | None:
        """Returns the value at a time, or None if the clip does not have a frame rate."""
        return None if self._fps is None else self.thousandths(self._fps.position_at(time)) / 1000

    def thousandths(self, position: int) -> int:
        """Returns the value at a position in 65,536ths of a frame, in thousandths."""
        index = self.index_at(position >> 16)
        if index < 0:
            return 0
        frames, values = self._frames, self._thousandths
        frame, value = frames[index], values[index]
        if position < frame << 16 or index + 1 >= len(frames) or frames[index + 1] <= position >> 16:
            return value
        whole = frames[index + 1] - frame << 16
        change = values[index + 1] - value
        moved = (2 * abs(change) * (position - (frame << 16)) + whole) // (2 * whole)
        return value + moved if change > 0 else value - moved

    def index_at(self, frame: int) -> int:
        """Returns the index of the last key at or before a frame, or of the first key; -1 without keys."""
        low, high = 0, len(self._frames)
        while low < high:
            middle = (low + high) // 2
            if self._frames[middle] <= frame:
                low = middle + 1
            else:
                high = middle
        return low - 1 if low else min(len(self._frames), 1) - 1

    def key(self, index: int) -> tuple[int, int] | None:
        """Returns the frame and the value, in thousandths, of the key with this index."""
        return (self._frames[index], self._thousandths[index]) if 0 <= index < len(self._frames) else None


class CurveTable:
    """The curves of all clips of a bank."""

    __slots__ = ("_clips", "_curves", "_units", "_events")

    def __init__(self, file: File, events: EventTable) -> None:
        clips, curves = file.section(b"CRVC"), file.section(b"CURV")
        self._clips = u32s(clips[: len(clips) // _PAIR.size * _PAIR.size])
        self._curves = curves[: len(curves) // _PAIR.size * _PAIR.size]
        self._units = file.section(b"CRVK")
        self._events = events

    def of(self, slot: int, fps: Fps | None) -> list[Curve]:
        """Returns the curves of the clip in a slot, in the order of their names."""
        place = place_of(self._clips, slot)
        if place is None:
            return []
        first: int = self._clips[2 * place + 1]
        count = len(self._curves) // _PAIR.size
        end = self._clips[2 * place + 3] if 2 * place + 3 < len(self._clips) else count
        curves = []
        for index in range(first, min(end, count)):
            curve = self._curve(index, fps)
            # Only a damaged bank has such a curve.
            if curve is None:
                break
            curves.append(curve)
        return curves

    def _curve(self, index: int, fps: Fps | None) -> Curve | None:
        start, name_and_width = _PAIR.unpack_from(self._curves, index * _PAIR.size)
        behind = (index + 1) * _PAIR.size
        whole = len(self._units) // 4
        end = _PAIR.unpack_from(self._curves, behind)[0] if behind < len(self._curves) else whole
        name = self._events.name(name_and_width & ~_WIDE)
        if name is None or not start <= end <= whole:
            return None
        return Curve(name, fps, self._units[4 * start : 4 * end], name_and_width & _WIDE != 0)


def place_of(records: memoryview | tuple[int, ...], slot: int) -> int | None:
    """Returns the index of the pair of numbers that starts with this slot. The slots are in ascending order."""
    low, high = 0, len(records) // 2
    while low < high:
        middle = (low + high) // 2
        if records[2 * middle] < slot:
            low = middle + 1
        else:
            high = middle
    return low if 2 * low < len(records) and records[2 * low] == slot else None
