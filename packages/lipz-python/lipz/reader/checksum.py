"""The checksum of a file, which detects damage (docs/reference/bank-format.md, "Checksum")."""

from __future__ import annotations

import struct

from .ids import U64

_P1 = 0x9E37_79B1_85EB_CA87
_P2 = 0xC2B2_AE3D_27D4_EB4F
_P3 = 0x1656_67B1_9E37_79F9
_P4 = 0x85EB_CA77_C2B2_AE63
_FIRST = 16
_STRIPE = struct.Struct("<4Q")


def checksum_of(view: memoryview) -> int:
    """Returns the checksum of a whole file. A megabyte takes about a quarter of a second."""
    a, b, c, d = (_P1 + _P2) & U64, _P2, 0, -_P1 & U64
    data = view[_FIRST:]
    whole = len(data) // _STRIPE.size * _STRIPE.size
    tail = (bytes(data[whole:]) + b"\x01").ljust(_STRIPE.size, b"\0")
    for part in (data[:whole], tail):
        for words in _STRIPE.iter_unpack(part):
            a, b, c, d = (_round(lane, word) for lane, word in zip((a, b, c, d), words))
    value = (_rotated(a, 1) + _rotated(b, 7) + _rotated(c, 12) + _rotated(d, 18)) & U64
    for lane in (a, b, c, d):
        value = ((value ^ _round(0, lane)) * _P1 + _P4) & U64
    value = (value + whole + _STRIPE.size) & U64
    value = (value ^ value >> 33) * _P2 & U64
    value = (value ^ value >> 29) * _P3 & U64
    return value ^ value >> 32


def _round(lane: int, word: int) -> int:
    return _rotated((lane + word * _P2) & U64, 31) * _P1 & U64


def _rotated(value: int, bits: int) -> int:
    return (value << bits | value >> 64 - bits) & U64
