"""The extension, built and imported as Blender does: as a package with a name of its own."""

import atexit
import importlib
import os
import shutil
import sys
import tempfile
import unittest
import zipfile

PACKAGE = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
BANKS = os.path.join(os.path.dirname(os.path.dirname(PACKAGE)), "fixtures", "banks", "v1")
# Any name works, because the extension has only relative imports.
NAME = "extension_of_lipz"

sys.path.insert(0, PACKAGE)
from build import build  # noqa: E402

FOLDER = tempfile.mkdtemp()
atexit.register(shutil.rmtree, FOLDER, ignore_errors=True)
ARCHIVE = build(FOLDER)
with zipfile.ZipFile(ARCHIVE) as archive:
    NAMES = archive.namelist()
    archive.extractall(os.path.join(FOLDER, NAME))
sys.path.insert(0, FOLDER)

try:
    import bpy
except ImportError:
    bpy = None
    # Without Blender, only the modules that do not need it.
    sys.modules[NAME] = type(sys)(NAME)
    sys.modules[NAME].__path__ = [os.path.join(FOLDER, NAME)]


def skip(needs):
    """Skips a test that needs a tool. Fails if LIPZ_TOOLS is set, because tools are then required."""
    if "LIPZ_TOOLS" in os.environ:
        raise AssertionError(f"needs {needs}, because LIPZ_TOOLS is set")
    raise unittest.SkipTest(f"needs {needs}")


def module(name):
    """Returns a module of the extension."""
    return importlib.import_module(f"{NAME}.{name}")


def bank(name):
    """Returns a golden bank."""
    with open(os.path.join(BANKS, f"{name}.lipzbank"), "rb") as file:
        return module("reader").Bank(file.read())
