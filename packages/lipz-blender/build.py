"""Writes the extension as a zip file, with the reader of the Python package: `python3 build.py [FOLDER]`."""

import os
import re
import sys
import zipfile

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
READER = os.path.join(ROOT, "packages", "lipz-python", "lipz", "reader")


def files():
    """Returns the name in the extension and the path of each file."""
    for folder, prefix in ((os.path.join(HERE, "lipz"), ""), (READER, "reader/")):
        for name in sorted(os.listdir(folder)):
            if name.endswith((".py", ".toml")) or name.startswith("LICENSE-"):
                yield prefix + name, os.path.join(folder, name)
    for name in ("LICENSE-APACHE", "LICENSE-MIT"):
        yield name, os.path.join(ROOT, name)


def build(folder):
    """Writes the extension into a folder, and returns its path."""
    with open(os.path.join(HERE, "lipz", "blender_manifest.toml"), encoding="utf-8") as file:
        version = re.search(r'^version = "(.*)"$', file.read(), re.M).group(1)
    path = os.path.join(folder, f"lipz-blender-{version}.zip")
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, source in files():
            archive.write(source, name)
    return path


if __name__ == "__main__":
    print(build(sys.argv[1] if len(sys.argv) > 1 else "."))
