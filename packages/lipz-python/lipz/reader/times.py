"""Points in time, and the frame at each of them, in exact arithmetic."""

from __future__ import annotations

import struct

MICROS_PER_SECOND = 1_000_000
# The number of the frame from which on every clip is over.
LATEST = 0xFFFF_FFFF
# The number of the frame before the start.
WAITING = -1
# The last position: a frame and 65,535 of its 65,536 parts.
_LAST_POSITION = LATEST << 16 | 0xFFFF
# Farther from the next frame, a product of floating-point numbers is in the right frame.
_MARGIN = 1e-5
_LATEST_ESTIMATE = 4e9


class Micros(int):
    """A time in microseconds."""


class Samples:
    """A time in samples: the position in a recording, and its sample rate."""

    __slots__ = ("position", "rate_hz")

    def __init__(self, position: int, rate_hz: int) -> None:
        self.position = position
        self.rate_hz = rate_hz


TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Union

    # A time since the start of the audio. Numbers are seconds.
    Time = Union[float, Micros, Samples]


class Fps:
    """A frame rate: `numerator` frames in `denominator` seconds."""

    __slots__ = ("numerator", "denominator", "rate")

    def __init__(self, numerator: int, denominator: int = 1) -> None:
        if not 0 < denominator <= numerator <= 1000 * denominator:
            raise ValueError(f"a frame rate must be from 1 to 1000, but not {numerator}/{denominator}")
        divisor, rest = numerator, denominator
        while rest:
            divisor, rest = rest, divisor % rest
        self.numerator = numerator // divisor
        self.denominator = denominator // divisor
        self.rate = self.numerator / self.denominator

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Fps) and (self.numerator, self.denominator) == (other.numerator, other.denominator)

    def __hash__(self) -> int:
        return hash((self.numerator, self.denominator))

    def __repr__(self) -> str:
        return f"Fps({self.numerator}, {self.denominator})"

    def frame_at(self, time: Time) -> int:
        """Returns the number of the frame at a time, `WAITING` before the start, or `LATEST` if it is that late."""
        if type(time) is float:
            estimate = time * self.rate
            if 0.0 < estimate < _LATEST_ESTIMATE:
                frame = int(estimate)
                if _MARGIN < estimate - frame < 1.0 - _MARGIN:
                    return frame
        ratio = _ratio_of(time)
        if ratio is None:
            return WAITING
        frame = ratio[0] * self.numerator // (ratio[1] * self.denominator)
        return frame if frame < LATEST else LATEST

    def position_at(self, time: Time) -> int:
        """Returns a time in 65,536ths of a frame; 0 before the start."""
        ratio = _ratio_of(time)
        if ratio is None:
            return 0
        position = (ratio[0] * self.numerator << 16) // (ratio[1] * self.denominator)
        return position if position < LATEST << 16 else _LAST_POSITION

    def start_of_frame_us(self, frame: int) -> int:
        """Returns the first microsecond in a frame."""
        return -(-frame * self.denominator * MICROS_PER_SECOND // self.numerator)


MILLISECONDS = Fps(1000)
_INFINITE = (1 << 64, 1)


def _ratio_of(time: Time) -> tuple[int, int] | None:
    """Returns a time in seconds as numerator and denominator, or None before the start.

    A float counts as two units in the last place later, so that `n / fps` leads to frame n.
    """
    if isinstance(time, Micros):
        return (int(time), MICROS_PER_SECOND) if time >= 0 else None
    if isinstance(time, Samples):
        return (time.position, time.rate_hz) if time.position >= 0 and time.rate_hz > 0 else None
    if isinstance(time, int):
        return (time, 1) if time >= 0 else None
    seconds = float(time)
    if not seconds >= 0.0:
        return None
    (bits,) = struct.unpack("<Q", struct.pack("<d", seconds + 0.0))
    exponent, fraction = bits >> 52, bits & 0xF_FFFF_FFFF_FFFF
    if exponent == 2047:
        return _INFINITE
    if exponent == 0:
        return fraction + 2, 1 << 1074
    mantissa, shift = (fraction | 1 << 52) + 2, 1075 - exponent
    return (mantissa, 1 << shift) if shift > 0 else (mantissa << -shift, 1)


def later(time: Time, us: int) -> Time:
    """Returns the time this many microseconds later."""
    if us == 0:
        return time
    if isinstance(time, Micros):
        return Micros(time + us)
    if isinstance(time, Samples):
        return Samples(time.position - -us * time.rate_hz // MICROS_PER_SECOND, time.rate_hz)
    moved = float(time) + us / MICROS_PER_SECOND
    # The start, within the tolerance of two units in the last place.
    return 0.0 if -2.0 * 2.0**-52 * us / MICROS_PER_SECOND <= moved < 0.0 else moved
