"""Edits files for translators with translate-toolkit, as Weblate does: the translations of two entries. Prints what it found: key,
source, translation and whether it counts as translated, of each entry, as JSON."""
import json
import sys

from translate.storage.pypo import pofile
from translate.storage.xliff import Xliff1File
from translate.storage.xliff2 import Xliff2File

CHANGED, NEW = "\u00c4", "- No, '=1"


def edited(kind, path):
    store = kind.parsefile(path)
    found = []
    for unit in store.units:
        if unit.isheader() or not unit.istranslatable():
            continue
        key = unit.getcontext() or unit.getid()
        found.append((key, str(unit.source), str(unit.target or ""), unit.istranslated()))
        if found[-1][2].rstrip(" |").endswith(CHANGED):
            unit.target = found[-1][2].replace(CHANGED, "\u00d6de")
        if found[-1][1] == NEW:
            unit.target = "- Nein, '=1"
            if isinstance(store, Xliff2File):
                unit.marktranslated()
    store.savefile(path)
    return found


json.dump([edited(kind, path) for kind, path in zip((pofile, Xliff2File, Xliff1File), sys.argv[1:])], sys.stdout)
