"""Changes entries of a translator's file with the libraries of other tools: polib, translate-toolkit, openpyxl and csv.

usage: deliver_texts.py FILE EDITS

EDITS is a JSON object: for each key, optionally the new `text`, whether it is `fuzzy`, and a `comment`. Prints the number of
changed entries.
"""
import csv
import json
import sys


def po(path, edits):
    import polib

    file = polib.pofile(path, encoding="utf-8")
    changed = 0
    for entry in file:
        edit = edits.get(entry.msgctxt)
        if edit is None:
            continue
        changed += 1
        entry.msgstr = edit.get("text", entry.msgstr)
        if "fuzzy" in edit:
            entry.flags = [flag for flag in entry.flags if flag != "fuzzy"] + (["fuzzy"] if edit["fuzzy"] else [])
        if "comment" in edit:
            entry.tcomment = "\n".join(filter(None, [entry.tcomment, edit["comment"]]))
    file.save(path)
    return changed


def set_target(unit, text):
    """Replaces a translation, segment by segment where the file marks them, as tools for segments do."""
    target = unit.get_target_dom()
    marks = [] if target is None else [node for node in target if node.tag.endswith("}mrk")]
    if not marks:
        unit.target = text
    for mark, part in zip(marks, text.split(" | ")):
        mark.text = part


def xliff(path, edits):
    from translate.storage.xliff import Xliff1File

    file = Xliff1File.parsefile(path)
    changed = 0
    for unit in file.units:
        edit = edits.get(unit.getid().split("\x04")[-1])
        if edit is None:
            continue
        changed += 1
        if "text" in edit:
            set_target(unit, edit["text"])
        if "fuzzy" in edit:
            unit.markfuzzy(edit["fuzzy"])
        if "comment" in edit:
            unit.addnote(edit["comment"], origin="translator")
    file.savefile(path)
    return changed


def rows_changed(rows, edits):
    """Changes the rows of a table, which are lists of strings."""
    header = rows[0]
    key, text, comment = (header.index(name) for name in ("key", "de-de", "comment de-de"))
    changed = 0
    for row in rows[1:]:
        edit = edits.get(row[key])
        if edit is None:
            continue
        changed += 1
        row[text] = edit.get("text", row[text])
        if "comment" in edit:
            row[comment] = "\n".join(filter(None, [row[comment], edit["comment"]]))
    return changed


def table(path, edits):
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    changed = rows_changed(rows, edits)
    with open(path, "w", newline="", encoding="utf-8") as file:
        csv.writer(file).writerows(rows)
    return changed


def sheet(path, edits):
    import openpyxl

    book = openpyxl.load_workbook(path)
    page = book.worksheets[0]
    rows = [["" if cell.value is None else str(cell.value) for cell in row] for row in page.iter_rows()]
    changed = rows_changed(rows, edits)
    for at, row in enumerate(rows, start=1):
        for column, value in enumerate(row, start=1):
            if value != (page.cell(at, column).value or ""):
                page.cell(at, column).value = value
    book.save(path)
    return changed


path, edits = sys.argv[1], json.loads(sys.argv[2])
kinds = {"po": po, "xlf": xliff, "csv": table, "xlsx": sheet}
print(json.dumps(kinds[path.rsplit(".", 1)[1]](path, edits)))
