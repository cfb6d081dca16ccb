"""Extracts the first C# program of a page, and the output that the page shows after it.

pages.py readme PAGE OUT   writes OUT/First.cs, a whole program, and OUT/expected.txt
pages.py guide PAGE OUT    writes OUT/Talk.cs and OUT/expected.txt
"""

import re
import sys
from pathlib import Path

WIDEST = 120
MOST_LINES = 17
PROGRAM = """using System;
using System.IO;
using Lipz;

internal static class First
{
    private static void Main()
    {
%s    }
}
"""


def main(kind, page, out):
    text = Path(page).read_text()
    start = text.index("```csharp\n")
    program, output = (re.search(rf"^```{name}\n(.*?)^```", text[start:], re.M | re.S) for name in ("csharp", "text"))
    lines = program.group(1).splitlines(keepends=True)
    assert len(lines) <= MOST_LINES and max(map(len, lines)) <= WIDEST, page
    folder = Path(out)
    folder.mkdir(parents=True, exist_ok=True)
    if kind == "readme":
        whole = PROGRAM % "".join(" " * 8 + line for line in lines)
        (folder / "First.cs").write_text(whole)
    else:
        (folder / "Talk.cs").write_text(program.group(1))
    (folder / "expected.txt").write_text(output.group(1))


main(*sys.argv[1:])
