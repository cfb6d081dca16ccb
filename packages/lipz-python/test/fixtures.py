"""The fixtures of the repository, which all readers share."""

import os
import sys
import unittest

PACKAGE = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
FIXTURES = os.path.join(os.path.dirname(os.path.dirname(PACKAGE)), "fixtures")
BANKS = os.path.join(FIXTURES, "banks", "v1")

if PACKAGE not in sys.path:
    sys.path.insert(0, PACKAGE)


def text(*path):
    """Returns the text of a fixture."""
    with open(os.path.join(FIXTURES, *path), encoding="utf-8", newline="\n") as file:
        return file.read()


def bank_bytes(name):
    """Returns the bytes of a golden bank or text bank."""
    with open(os.path.join(BANKS, name), "rb") as file:
        return file.read()


def fnv(data):
    """Returns the 64-bit FNV-1a hash of bytes."""
    value = 0xCBF29CE484222325
    for byte in data:
        value = (value ^ byte) * 0x100000001B3 & 0xFFFFFFFFFFFFFFFF
    return value


def skip(needs):
    """Skips a test that needs a tool. Fails if LIPZ_TOOLS is set, because tools are then required."""
    if "LIPZ_TOOLS" in os.environ:
        raise AssertionError(f"needs {needs}, because LIPZ_TOOLS is set")
    raise unittest.SkipTest(f"needs {needs}")


def assert_same(test, name, found, expected):
    """Compares two texts, and names the first line that differs."""
    if found != expected:
        pairs = zip(found.splitlines(), expected.splitlines())
        different = next((n for n, (one, other) in enumerate(pairs, 1) if one != other), 0)
        lines = [(text.splitlines() or [""])[max(different - 1, 0)][:400] for text in (found, expected)]
        test.fail(f"{name}:{different}: {lines[0]!r} instead of {lines[1]!r}")
