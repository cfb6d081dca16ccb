"""Spoken dialogue for games: the reader of banks, and the command `lipz`."""

from .command import Finding, Report, check, export, import_, pack, run, sync
from .reader import Bank, BankError, Clip, Cursor, Micros, Rig, Samples, Segment, Text, open_bank, shapes_of
from .program import path

__all__ = [
    "Bank",
    "BankError",
    "Clip",
    "Cursor",
    "Finding",
    "Micros",
    "Report",
    "Rig",
    "Samples",
    "Segment",
    "Text",
    "check",
    "export",
    "import_",
    "open_bank",
    "pack",
    "path",
    "run",
    "shapes_of",
    "sync",
]
