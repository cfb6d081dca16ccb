"""Extracts the programs of a page, whose first line names their file, and the output that follows them.

usage: pages.py PAGE OUT
"""

import re
import sys
from pathlib import Path


def main(page, out):
    text = Path(page).read_text("utf-8")
    programs = re.findall(r"```cpp\n// (\S+)\n(.*?)```", text, re.S)
    output = re.findall(r"```text\n(.*?)```", text, re.S)
    if not programs or len(output) != 1:
        sys.exit(f"{page}: expected programs and their output")
    for name, program in programs:
        Path(out, name).write_text(program, "utf-8")
    Path(out, "expected.txt").write_text(output[0], "utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:])
