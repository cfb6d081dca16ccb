"""Translates the plural forms of a PO file with polib or translate-toolkit, as Poedit and Weblate do. Form number N of an
entry becomes "N: " and the source of its plural. Prints the contexts of the entries.

usage: plural_texts.py polib|translate FILE
"""
import json
import sys

tool, path = sys.argv[1:]
if tool == "polib":
    import polib

    file = polib.pofile(path, encoding="utf-8")
    entries = [entry for entry in file if entry.msgid_plural]
    for entry in entries:
        entry.msgstr_plural = {form: f"{form}: {entry.msgid_plural}" for form in entry.msgstr_plural}
    file.save(path)
    contexts = [entry.msgctxt for entry in entries]
else:
    from translate.misc.multistring import multistring
    from translate.storage.pypo import pofile

    file = pofile.parsefile(path)
    entries = [unit for unit in file.units if unit.hasplural()]
    for unit in entries:
        count = len(unit.target.strings)
        unit.target = multistring([f"{form}: {unit.source.strings[1]}" for form in range(count)])
    file.savefile(path)
    contexts = [unit.getcontext() for unit in entries]
print(json.dumps(contexts))
