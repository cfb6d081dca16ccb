"""Babble: generated mouth movement for a voice without visemes."""

from __future__ import annotations

import struct

from .times import Fps, LATEST

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .times import Time

_RECORD = struct.Struct("<QIIHHHHH6x")
_TEN_THOUSANDTHS_PER_PRODUCT = 121
# The power to use for a voice that is not measured.
UNMEASURED = 0.75


class Babble:
    """Loops of digits for lips and jaw, which the power of the voice modulates."""

    __slots__ = ("name", "rate", "_ooh", "_aah")

    def __init__(self, name: str, rate: Fps, digits: tuple[bytes, bytes, bytes, bytes]) -> None:
        self.name = name
        # Digits per second.
        self.rate = rate
        # The loop and the power transfer of the lips and of the jaw.
        self._ooh = digits[0], digits[2]
        self._aah = digits[1], digits[3]

    def at(self, elapsed: Time, power: float = UNMEASURED) -> tuple[float, float]:
        """Returns how far lips and jaw have moved this long after the start of speech, from 0 to 0.99.

        `power` is that of the voice, from 0 to 1.
        """
        index = self.rate.frame_at(elapsed)
        if not 0 <= index < LATEST:
            return 0.0, 0.0
        return _product(self._ooh, index, power), _product(self._aah, index, power)


DEFAULT_BABBLE = Babble(
    "default",
    Fps(24),
    (b"1247898743223344444443200000", b"257998776531013446642343", b"0012345566778899", b"0000123456789"),
)


def _product(loop_and_transfer: tuple[bytes, bytes], index: int, power: float) -> float:
    loop, transfer = loop_and_transfer
    if not loop or not transfer:
        return 0.0
    # The arithmetic of the viewer has 32 bits.
    (position,) = struct.unpack("<f", struct.pack("<f", len(transfer) * min(power, 1.0) if power > 0 else 0.0))
    factor = transfer[int(min(position, len(transfer) - 1))]
    return _digit(loop[index % len(loop)]) * _digit(factor) * _TEN_THOUSANDTHS_PER_PRODUCT / 10_000


def _digit(code: int) -> int:
    return code - 48 if 48 <= code <= 57 else 0


def babbles_in(data: memoryview) -> list[Babble]:
    """Returns the profiles of a section. A damaged profile ends the list."""
    profiles = []
    at = 0
    while at + _RECORD.size <= len(data):
        _, numerator, denominator, *lengths = _RECORD.unpack_from(data, at)
        at += _RECORD.size
        parts = []
        for length in lengths:
            parts.append(bytes(data[at : at + length]))
            at += length
        if at > len(data) or not 0 < denominator <= numerator <= 1000 * denominator:
            break
        name = parts[0].decode("utf-8", "replace")
        profiles.append(Babble(name, Fps(numerator, denominator), (parts[1], parts[2], parts[3], parts[4])))
    return profiles
