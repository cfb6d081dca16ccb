"""A game in a folder: the sample with the bank of the fixtures, and silent recordings."""

import os
import shutil
import unittest
import wave

PACKAGE = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
ROOT = os.path.dirname(os.path.dirname(PACKAGE))
READER = os.path.join(ROOT, "packages", "lipz-python", "lipz", "reader")
BANK = os.path.join(ROOT, "fixtures", "banks", "v1", "drama.lipzbank")
KEYS = ("act1/mara-good-evening", "act1/otto-twenty-years")
SECONDS = 1.5
RATE_HZ = 24_000


def write(folder):
    """Writes the game into a folder."""
    game = os.path.join(folder, "game")
    os.makedirs(os.path.join(game, "voice", "act1"))
    shutil.copy(os.path.join(PACKAGE, "lipz.rpy"), game)
    shutil.copy(os.path.join(PACKAGE, "sample", "script.rpy"), game)
    shutil.copy(os.path.join(PACKAGE, "test", "spy.rpy"), game)
    shutil.copytree(READER, os.path.join(game, "python-packages", "lipz_reader"))
    shutil.copy(BANK, os.path.join(game, "dialogue.lipzbank"))
    for key in KEYS:
        # Ren'Py detects the format of a recording by its contents.
        with wave.open(os.path.join(game, "voice", f"{key}.ogg"), "wb") as sound:
            sound.setparams((1, 2, RATE_HZ, 0, "NONE", ""))
            sound.writeframes(bytes(2 * int(SECONDS * RATE_HZ)))


def skip(needs):
    """Skips a test that needs a tool. Fails if LIPZ_TOOLS is set, because tools are then required."""
    if "LIPZ_TOOLS" in os.environ:
        raise AssertionError(f"needs {needs}, because LIPZ_TOOLS is set")
    raise unittest.SkipTest(f"needs {needs}")
