"""Spoken dialogue for games: the reader of banks, and the command `lipz`."""

from .reader import Bank, BankError, Clip, Cursor, Micros, Rig, Samples, Segment, Text, open_bank, shapes_of
from .program import path

__all__ = [
    "Bank",
    "BankError",
    "Clip",
    "Cursor",
    "Micros",
    "Rig",
    "Samples",
    "Segment",
    "Text",
    "open_bank",
    "path",
    "shapes_of",
]
