"""Prints what Python's own parsers find in files for translators: id, source and translation of each entry, as JSON."""
import json
import sys
import xml.etree.ElementTree as tree

import openpyxl
import polib

XLIFF2 = "{urn:oasis:names:tc:xliff:document:2.0}"
XLIFF1 = "{urn:oasis:names:tc:xliff:document:1.2}"


def content(element):
    return "" if element is None else "".join(element.itertext())


def entries(path):
    if path.endswith(".po"):
        return [(entry.msgctxt, entry.msgid, entry.msgstr) for entry in polib.pofile(path, check_for_duplicates=True)]
    if path.endswith(".xlsx"):
        rows = openpyxl.load_workbook(path).worksheets[0].iter_rows(values_only=True)
        names = next(rows)
        places = [names.index(name) for name in ("key", "en-us", "de-de")]
        return [tuple(row[place] or "" for place in places) for row in rows]
    root = tree.parse(path).getroot()
    if root.tag == XLIFF1 + "xliff":
        units = root.iter(XLIFF1 + "trans-unit")
        return [(u.get("id"), content(u.find(XLIFF1 + "source")), content(u.find(XLIFF1 + "target"))) for u in units]
    found = []
    for unit in root.iter(XLIFF2 + "unit"):
        data = {one.get("id"): content(one) for one in unit.iter(XLIFF2 + "data")}
        for code in unit.iter(XLIFF2 + "ph"):
            code.text = data[code.get("dataRef")]
        segments = [part for part in unit if part.tag in (XLIFF2 + "segment", XLIFF2 + "ignorable")]
        texts = [[content(part.find(XLIFF2 + name)) for part in segments] for name in ("source", "target")]
        found.append((unit.get("name"), *(" | ".join(one) for one in texts)))
    return found


json.dump([entries(path) for path in sys.argv[1:]], sys.stdout)
